"""Exact one-interval response of an oscillator, in 60 digits, for tests/physics/propagator.rs.

    python3 tests/reference/propagator.py > tests/reference/propagator.csv      (needs mpmath)

q'' + c q' + w^2 q = l0 + l1 t over 0..h from q, v. The matrix exponential of the augmented system is summed by
mpmath, which shares no formula with the library (power series, closed form, doubling).
"""
from mpmath import mp, mpf, matrix, expm, nstr

mp.dps = 60


def response(w, c, h):
    a = matrix(4, 4)  # q, v, load, slope
    a[0, 1] = 1
    a[1, 0], a[1, 1], a[1, 2] = -w * w, -c, 1
    a[2, 3] = 1
    mp.dps = 60 + int(2 * float(w * h) / 2.3 + float(c * h) / 2.3)
    e = expm(a * h, method="taylor")
    mp.dps = 60
    return [e[0, 0] - 1, e[0, 1], e[1, 0], e[1, 1] - 1, e[0, 2], e[0, 3], e[1, 2], e[1, 3]]


print("# w_rad_s, c_1_s, h_s, then q(h)-q, v(h)-v per unit q, v, load, slope: dqq,dqv,dvq,dvv,rq0,rq1,rv0,rv1")
h = 0.01
for reach in ["1e-8", "1e-4", "0.01", "0.3", "0.49", "0.51", "1", "3", "10", "100", "1000"]:
    for ratio in ["0", "0.001", "0.05", "0.5", "0.9", "0.96", "1", "1.5", "20"]:
        if float(reach) * float(ratio) > 300 or float(reach) > 300 and float(ratio) > 0.05:
            continue
        w = float(reach) / h
        c = 2 * float(ratio) * w
        values = response(mpf(w), mpf(c), mpf(h))
        print(",".join([repr(w), repr(c), repr(h)] + [nstr(v, 20) for v in values]))
# The stiffest that scenes hold, w h = 1e4: a closed form, since a series of that length is out of reach.
for ratio in ["0", "0.0001"]:
    w = 1e4 / h
    c = 2 * float(ratio) * w
    W, C, H = mpf(w), mpf(c), mpf(h)
    b = C / 2
    wd = mp.sqrt(W * W - b * b)
    e, s, k = mp.exp(-b * H), mp.sin(wd * H) / wd, mp.cos(wd * H)
    qq, qv, vq, vv = e * (k + b * s), e * s, -W * W * e * s, e * (k - b * s)
    rq0 = (1 - qq) / W**2
    rq1 = (H - C * rq0 - qv) / W**2
    values = [qq - 1, qv, vq, vv - 1, rq0, rq1, qv, rq0]
    print(",".join([repr(w), repr(c), repr(h)] + [nstr(v, 20) for v in values]))
