#!/usr/bin/env python3
"""A surface for lekalo as a program: a torus about the z axis, with its exact derivatives up to order 2.

  python3 torus.py MAJOR MINOR

Reads lines "u v order", answers each with a line of numbers: r, r_u, r_v, r_uu, r_uv, r_vv up to the order. An answer must
leave at once: flush after each line, or nothing arrives before the buffer is full.
"""

import sys
from math import cos, sin

major, minor = float(sys.argv[1]), float(sys.argv[2])
for line in sys.stdin:
    u, v, order = line.split()
    u, v, order = float(u), float(v), int(order)
    if order > 2:
        print("error no derivatives above order 2", flush=True)
        continue
    cu, su, cv, sv = cos(u), sin(u), cos(v), sin(v)
    rho = major + minor * cv
    out = [rho * cu, rho * su, minor * sv]
    if order >= 1:
        out += [-rho * su, rho * cu, 0]
        out += [-minor * sv * cu, -minor * sv * su, minor * cv]
    if order >= 2:
        out += [-rho * cu, -rho * su, 0]
        out += [minor * sv * su, -minor * sv * cu, 0]
        out += [-minor * cv * cu, -minor * cv * su, -minor * sv]
    print(*out, flush=True)
