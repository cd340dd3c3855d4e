#!/usr/bin/env bash
# gmprocess 2.8.0 (package index for Python, 2026) makes the step of records of BHRC (Iran) and RENADIC (Chile) too long.
#
# Expected: 20 samples at 200 Hz are 0.005 s apart. The file of BHRC says it twice, by its duration of 20 times 0.005 s and by number
# 9 of its real header, 200; in the file of RENADIC each sample stands beside its time.
# Seen: the step is the duration over the intervals between the samples, 0.1 s / 19 = 0.005263 s, though the duration in these files
# has an interval for each sample. The last sample of a record comes an interval late. Its reader of CSMIP has the same rule and
# rounds the rate to whole Hz.
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"
python3 -m venv with
with/bin/pip install --quiet gmprocess==2.8.0
cat > steps.py <<'PYTHON'
import warnings

warnings.filterwarnings("ignore")
from gmprocess.io.bhrc.core import read_bhrc
from gmprocess.io.renadic.core import read_renadic

SAMPLES = [0.01 * (-1) ** k * k for k in range(20)]


def lines(values, width, per_line, form):
    texts = [format(value, form).rjust(width) for value in values]
    return ["".join(texts[k : k + per_line]) for k in range(0, len(texts), per_line)]


def bhrc(component):
    reals = [0.02, 0.64, 0.1, 0, 0.1, 0, 0, 0, 200] + [0] * 41
    return [
        "* VOL1DS FILE:  1234/01", "Inst Type = SSA-2", "Origin Time : 2012/08/11   12:23:16", "", "L", "", "COMP " + component,
        "Nowhere                   Station   37.734 N 47.801 E   Altitude 2026m   Azimuth L 50    T 140",
        "Epicenter 38.520 N 46.860 E   FD 12 Km mb      Ms      Mw6.1   M        ML   (BHRC   )",
        "INSTR PERIOD =  .020 SEC   DAMPING =  .640", "NO. OF POINTS =     20      DURATION =   .100",
        "UNITS ARE SECONDS AND G/10", "",
        *[line[:70] for line in lines([0] * 100, 5, 16, "d")], *[line[:71] for line in lines(reals, 13, 8, ".6E")],
        *lines(SAMPLES, 13, 10, ".6E"), "/&",
    ]


def renadic(channel, name):
    pairs = [number for k, sample in enumerate(SAMPLES) for number in (0.005 * k, sample)]
    return [
        "UNCORRECTED ACCELEROGRAM DATA              PROCESSED: 06/30/2011", "SOMEWHERE",
        "11/13/2009 3:05:27 (GMT)                (ORIGIN: 11/13/2009 3:05:27 GMT)",
        "                                   TRIGGER TIME: 11/13/2009 3:06:17.600 GMT",
        "STATION NO.         18.483S   70.314W  SMA-1     S/N  815 (3  CHNS OF 3  AT STA)", "NOWHERE S/N 815",
        f"CHAN  {channel}: {name:<9}(STA CHN:  {channel})", "UNIVERSIDAD DE CHILE - RENADIC",
        "HYPOCENTER:   0.000N    0.000E  H=   0.0KM   ML= 0.00",
        "INSTR PERIOD = 0.0195 SEC,  DAMPING =0.6500,  SENSITIVITY =2.508 VDC/G",
        "NO. OF POINTS =     20  RECORD LENGTH =  0.100 SEC",
        "UNITS OF UNCOR ACCEL ARE SEC AND G/10.     MAX  = -0.019 G, AT   0.095 SEC", "RMS ACCEL OF COMPLETE RECORD = 0.011 G",
        *lines([0] * 100, 5, 16, "d"), *lines([0.0] * 50, 10, 8, ".3f"), *lines(pairs, 7, 10, ".3f"),
        f"/&  ----------  END OF DATA FOR CHANNEL {channel}  ----------",
    ]


def steps(name, text, read):
    with open(name, "w") as file:
        file.write("\n".join(text) + "\n")
    traces = read(name)[0]
    assert all(trace.stats.npts == 20 for trace in traces)
    return {round(trace.stats.delta, 9) for trace in traces}


found = {
    "BHRC": steps("a.V1", bhrc("L1") + bhrc("V2") + bhrc("T3"), read_bhrc),
    "RENADIC": steps("a.v1", renadic(1, "EW") + renadic(2, "NS") + renadic(3, "V"), read_renadic),
}
print(found)
assert found == {"BHRC": {0.005263158}, "RENADIC": {0.005263158}}, "the steps are others now"
PYTHON
with/bin/python steps.py
