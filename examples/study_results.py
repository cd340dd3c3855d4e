"""The table of a study: it grows while the study runs, and a study that was stopped goes on from it."""

import csv
import os

CASE = {
    "scene": str, "scene_id": str, "record": str, "record_id": str, "pga_m_s2": float, "gap_m": float, "stop_s": float
}  # fmt: skip
RESULT = {
    "impacts": int, "peak_force_n": float, "impulse_n_s": float, "dissipated_energy_j": float,
    "left_drift_m": float, "right_drift_m": float, "error": str,
}  # fmt: skip
COLUMNS = {**CASE, **RESULT}


class Results:
    """Rows by case. A case is what its columns say, numbers by their shortest text."""

    def __init__(self, path):
        self.path = path
        path.parent.mkdir(parents=True, exist_ok=True)
        self.file = path.open("a+", newline="")
        self.lock()
        self.rows = {}
        self.read()

    def lock(self):
        """Two studies at once would write each row twice. The lock goes with its process, however that ends."""
        try:
            import fcntl

            fcntl.flock(self.file, fcntl.LOCK_EX | fcntl.LOCK_NB)
        except ImportError:
            pass
        except OSError:
            raise SystemExit(f"{self.path}: another study is writing here") from None

    def read(self):
        """Takes what is there; a row that a killed run has not finished is cut off."""
        content = self.path.read_bytes()
        whole = content.rfind(b"\n") + 1
        if whole < len(content):
            self.file.truncate(whole)
        lines = list(csv.reader(content[:whole].decode().splitlines()))
        if not lines:
            self.file.write(",".join(COLUMNS) + "\n")
            self.file.flush()
        elif lines[0] != list(COLUMNS):
            raise SystemExit(f"{self.path}: expected the columns {','.join(COLUMNS)}")
        for line in lines[1:]:
            self.rows[tuple(line[: len(CASE)])] = line

    def add(self, rows):
        """Writes rows and waits until the disk has them."""
        for case, result in rows:
            line = [*key(case), *texts(result)]
            self.rows[key(case)] = line
            csv.writer(self.file, lineterminator="\n").writerow(line)
        self.file.flush()
        os.fsync(self.file.fileno())

    def missing(self, cases):
        """Cases without a result; those that failed are tried again."""
        done = {case for case, row in self.rows.items() if not row[-1]}
        return [case for case in cases if key(case) not in done]

    def of(self, cases):
        """The rows of these cases as dictionaries, errors left out."""
        found = [dict(zip(COLUMNS, self.rows[key(case)])) for case in cases if key(case) in self.rows]
        return [{name: kind(row[name]) for name, kind in COLUMNS.items()} for row in found if not row["error"]]

    def finish(self, cases):
        """Puts the rows in the order of the cases, whoever ran them; those of other cases stay behind them."""
        first = {key(case): self.rows[key(case)] for case in cases if key(case) in self.rows}
        ordered = first | dict(sorted(self.rows.items()))
        new = self.path.with_suffix(".new")
        with new.open("w", newline="") as file:
            csv.writer(file, lineterminator="\n").writerows([list(COLUMNS), *ordered.values()])
            file.flush()
            os.fsync(file.fileno())
        os.replace(new, self.path)

    def close(self):
        self.file.close()


def key(case):
    """What names a case in the table."""
    names = (case.scene, case.scene_id, case.record, case.record_id)
    return (*names, *(repr(float(number)) for number in (case.pga, case.gap, case.stop)))


def texts(result):
    names = ["impacts", "peak_force", "impulse", "dissipated_energy", "left_drift", "right_drift", "error"]
    return [result[name] if name == "error" else repr(result[name]) if name in result else "" for name in names]
