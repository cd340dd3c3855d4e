"""Writes docs/validation.md: case, inputs, published value, ours, verdict.

"$(ci/environment)" examples/paper/validation.py
"""

import closed_forms
import energies
import feup
import filiatrault
import heights
import isolated
import scenes
import statement
import towers

PAGE = scenes.ROOT / "docs/validation.md"


def parts():
    return {
        "closed forms": closed_forms_table(),
        "published values": published_table(),
        "published findings": findings_table(),
    }


def closed_forms_table():
    body = []
    for check in closed_forms.checks():
        verdict = "agrees" if check.agrees() else "**does not agree**"
        body.append([check.case, check.formula, check.source, f"{check.expected:.9g}", f"{check.ours:.9g}", verdict])
    return statement.table(["case", "formula", "source", "expected", "ours", "verdict"], body)


def published_table():
    source = "[BarrosKhatami2013, {}]"
    body = []
    for frame, mode, published, ours in feup.frequencies():
        verdict = "agrees" if feup.agrees(published, ours) else "**does not agree**"
        case = [
            f"FEUP frame, {frame}: natural frequency {mode}",
            f"3.65 kg a floor, 2910 N/m a storey {source.format('section 3.2')}",
        ]
        body.append([*case, f"{published} Hz", f"{ours:.4f} Hz", verdict])
    for equation, formula, name in energies.READINGS:
        case = [
            f"energy of one impact, {name}",
            f"50 t and 75 t, e = 0.5, V = {100 * energies.SPEED:.4f} cm/s from Y(t) in cm "
            f"{source.format('section 4.2')}",
        ]
        body.append(
            [
                *case,
                f"{energies.PUBLISHED[equation]} kN mm",
                f"{energies.loss(formula):.3f} kN mm",
                "cannot be obtained",
            ]
        )
    largest = {height: [] for height in heights.HEIGHTS}
    for (_, _, height), (forces, _) in heights.sweep(scenes.EL_CENTRO).items():
        largest[height].append(max(forces) / 1e3)
    for height in heights.HEIGHTS:
        case = [
            f"largest force, {height} storey{'s' if height > 1 else ''}",
            f"50 t and 75 t a floor, gap 5 mm, 0.7105 g; El Centro instead of Kobe, periods and laws varied "
            f"{source.format('section 4.3')}",
        ]
        body.append(
            [
                *case,
                f"{heights.PUBLISHED[height]:g} kN",
                f"{min(largest[height]):.0f} to {max(largest[height]):.0f} kN",
                "cannot be obtained",
            ]
        )
    for where, test, measured in filiatrault.MEASURED:
        found = filiatrault.ours(where, test)
        case = [
            f"shaking table test, largest acceleration: {where}, {test}",
            f"storeys, gap, 12.8 kN/mm, El Centro at 0.5 g; masses, periods varied, 2 % of damping [Filiatrault1995], "
            f"{source.format('section 3.1')}",
        ]
        within = "within the range" if min(found) <= measured <= max(found) else "outside of the range"
        body.append(
            [*case, f"{measured:g} g", f"{min(found):.1f} to {max(found):.1f} g", f"{within}: order of magnitude only"]
        )
    return statement.table(["case", "inputs", "published", "ours", "verdict"], body)


def findings_table():
    body = [[case, of.paper, source, of.found, of.verdict] for case, source, found in findings() for of in found]
    return statement.table(["case", "published finding", "source", "ours", "verdict"], body)


def findings():
    return [
        ("two towers under a sine", "[Chau2003]", towers.statements()),
        ("an isolated building in its moat", "[Komodromos2007]", isolated.statements()),
        ("frames of 8 and 3 storeys on a shaking table", "[Filiatrault1995]", filiatrault.statements()[1:]),
    ]


def main():
    statement.publish(parts(), PAGE)


if __name__ == "__main__":
    main()
