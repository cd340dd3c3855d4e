#!/usr/bin/env bash
# pyRotd 0.6.1 (package index for Python, 2026) lets the swing after the end of a record run into its beginning.
#
# Expected: half a sine of 0.5 s and 9.5 s of rest are a record, and more rest after it changes no spectral acceleration: the largest
# swing of an oscillator comes soon after the pulse.
# Seen: with 5 % of critical damping the spectral acceleration at 2 s is 1.10 m/s2 with 9.5 s of rest and 0.87 m/s2 with 159.5 s, that
# at 4 s 0.31 and 0.46 m/s2. The response is worked out by a Fourier transform of the samples as they are, which repeat: an oscillator
# does not begin at rest, but with what it would have at the end of the record. Whoever adds rest, a period over the damping ratio of
# it, gets what other programs have.
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"
python3 -m venv with
with/bin/pip install --quiet pyRotd==0.6.1 numpy==2.4.6
cat > spectra.py <<'PYTHON'
import numpy as np
import pyrotd

STEP = 0.02  # s


def spectral_accelerations(length, periods):
    times = np.arange(0.0, length, STEP)
    record = np.where(times < 0.5, np.sin(2.0 * np.pi * times), 0.0)
    return [float(pyrotd.calc_spec_accels(STEP, record, np.array([1.0 / period]), 0.05).spec_accel[0]) for period in periods]


found = {length: spectral_accelerations(length, [2.0, 4.0]) for length in (10.0, 80.0, 160.0)}
print({length: [round(value, 3) for value in values] for length, values in found.items()})
short, long, longer = found.values()
assert all(abs(a / b - 1.0) < 0.01 for a, b in zip(long, longer)), "rest does not settle it"
assert short[0] > 1.2 * longer[0] and short[1] < 0.75 * longer[1], "the swing does not run into the beginning any more"
PYTHON
with/bin/python spectra.py
