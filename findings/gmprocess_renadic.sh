#!/usr/bin/env bash
# gmprocess 2.8.0 (package index for Python, 2026) does not know files of RENADIC (Chile) from those of CSMIP, and reads them with
# another g.
#
# Expected: read_data reads a file of each of its formats, and 0.19 tenths of g are 0.19 x 98.0665 = 18.6326 cm/s2, as in its readers
# of the other formats in tenths of g.
# Seen: read_data refuses the file, since two of its formats take it for theirs. Its reader of RENADIC, asked by name, gives
# 18.62 cm/s2: it takes 980 cm/s2 for one g, so that all accelerations are 0.07 percent low.
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"
python3 -m venv with
with/bin/pip install --quiet gmprocess==2.8.0
cat > peak.py <<'PYTHON'
import warnings

warnings.filterwarnings("ignore")
from gmprocess.io.read import read_data
from gmprocess.io.renadic.core import read_renadic


def lines(values, width, per_line, form):
    texts = [format(value, form).rjust(width) for value in values]
    return ["".join(texts[k : k + per_line]) for k in range(0, len(texts), per_line)]


def channel(number, name):
    pairs = [value for k in range(20) for value in (0.005 * k, 0.01 * (-1) ** k * k)]
    return [
        "UNCORRECTED ACCELEROGRAM DATA              PROCESSED: 06/30/2011", "SOMEWHERE",
        "11/13/2009 3:05:27 (GMT)                (ORIGIN: 11/13/2009 3:05:27 GMT)",
        "                                   TRIGGER TIME: 11/13/2009 3:06:17.600 GMT",
        "STATION NO.         18.483S   70.314W  SMA-1     S/N  815 (3  CHNS OF 3  AT STA)", "NOWHERE S/N 815",
        f"CHAN  {number}: {name:<9}(STA CHN:  {number})", "UNIVERSIDAD DE CHILE - RENADIC",
        "HYPOCENTER:   0.000N    0.000E  H=   0.0KM   ML= 0.00",
        "INSTR PERIOD = 0.0195 SEC,  DAMPING =0.6500,  SENSITIVITY =2.508 VDC/G",
        "NO. OF POINTS =     20  RECORD LENGTH =  0.100 SEC",
        "UNITS OF UNCOR ACCEL ARE SEC AND G/10.     MAX  = -0.019 G, AT   0.095 SEC", "RMS ACCEL OF COMPLETE RECORD = 0.011 G",
        *lines([0] * 100, 5, 16, "d"), *lines([0.0] * 50, 10, 8, ".3f"), *lines(pairs, 7, 10, ".3f"),
        f"/&  ----------  END OF DATA FOR CHANNEL {number}  ----------",
    ]


with open("a.v1", "w") as file:
    file.write("\n".join(channel(1, "EW") + channel(2, "NS") + channel(3, "V")) + "\n")
try:
    read_data("a.v1")
    raise SystemExit("read_data takes the file now")
except ValueError as error:
    print(error)
    assert "Multiple formats passing" in str(error)
peak = max(abs(read_renadic("a.v1")[0][0].data))
print(peak, "cm/s2")
assert round(peak, 6) == 18.62, "the peak is another one now"
PYTHON
with/bin/python peak.py
