"""Makes the golden cases: `python3 tests/golden/generate [--check] [NAME...]`. `../README.md` has what they are.

With `--check` nothing is written: what would be is compared with the files, and the command fails where numbers differ by more
than `TOLERANCE`, relative to 1 + their magnitude.
"""
import json
import sys
from math import inf, isfinite
from pathlib import Path

import movements
import numpy as np
import pointing
import sequences
from scipy.linalg import block_diag

FOLDER = Path(__file__).resolve().parent.parent
# E[x x'] - E[x] E[x]' cancels, 600 px from the origin: that alone is beyond 1e-12
TOLERANCE = 1e-11


def moving(type, noise, dimensions=2, **others):
    return {"type": type, "dimensions": dimensions, "noise": noise, **others}


def velocity(noise, dimensions=2):
    return moving("constantVelocity", noise, dimensions)


def uniform(start, end):
    return {"type": "uniform", "from": start, "to": end}


ACCELERATION = moving("constantAcceleration", 20.0)
REVERTING = moving("meanReverting", 1.0, rate=0.8)
EQUILIBRIUM = moving("equilibriumRevertingVelocity", 2.0, stiffness=4.0, damping=3.0)
DRIFTING = moving("integratedOrnsteinUhlenbeck", 2.0, damping=1.5, drift=[0.4, -0.2])
CUSTOM = {
    "type": "custom",
    "dimensions": 2,
    "drift": [[0, 0, 1, 0], [0, 0, 0, 1], [-1, 0, -1.2, 0.3], [0, -1, -0.3, -1.2]],
    "diffusion": [[0, 0, 0, 0], [0, 0, 0, 0], [0, 0, 4, 0.5], [0, 0, 0.5, 4]],
    "offset": [0, 0, 0.1, 0],
    "destinationGain": [[0, 0], [0, 0], [1, 0], [0, 1]],
}
LATE = uniform(1.0, 4.0)
HORIZON = {"type": "horizon", "from": 0.1, "to": 1.5}
DISCRETE = {"type": "discrete", "times": [1.0, 2.0, 3.0], "weights": [1, 2, 1]}
SIMPSON, SIMPSON_9 = ({"rule": "simpson", "points": points} for points in (15, 9))
TRAPEZOID, LEGENDRE = {"rule": "trapezoid", "points": 11}, {"rule": "gaussLegendre", "points": 9}
PIXELS = {"scale": 200.0, "deviation": 0.01, "destinations": 21}

# seed, motion, components of an endpoint, arrival, quadrature; and what is otherwise
MOVEMENTS = {
    "cv2d-position": ((1, velocity(2.0), 2, LATE, SIMPSON), {}),
    "cv2d-position-velocity": ((2, velocity([2.0, 1.5]), 4, LATE, SIMPSON), {"correlated": True}),
    "cv3d-position": ((3, velocity(2.0, 3), 3, LATE, LEGENDRE), {"destinations": 6}),
    "brownian2d": ((4, moving("brownian", 1.5), 2, LATE, SIMPSON), {}),
    "ca2d": ((5, ACCELERATION, 4, LATE, TRAPEZOID), {}),
    "mean-reverting2d": ((6, REVERTING, 2, LATE, SIMPSON), {}),
    "erv2d": ((7, EQUILIBRIUM, 4, LATE, SIMPSON), {}),
    "iou2d": ((8, DRIFTING, 2, DISCRETE, None), {}),
    "cv2d-expiring-nodes": ((9, velocity(2.0), 2, uniform(0.5, 4.0), SIMPSON), {}),
    "cv2d-horizon": ((10, velocity(2.0), 2, HORIZON, SIMPSON_9), {}),
    "cv2d-same-timestamp": ((11, velocity(2.0), 4, LATE, SIMPSON), {"repeats": True}),
    "custom2d": ((12, CUSTOM, 4, LATE, SIMPSON), {"correlated": True}),
    "cv2d-pixels": ((13, velocity(3000.0), 2, uniform(1.0, 3.0), SIMPSON), PIXELS),
}

# seed, layout, number of targets
POINTING = {
    "pointing-grid21": ((31, "grid", 21), {}),
    "pointing-ring12": ((32, "ring", 12), {}),
    "pointing-sizes40": ((33, "sizes", 40), {}),
    "pointing-repeats": ((34, "grid", 21), {"repeats": True}),
    "pointing-none": ((35, "sizes", 9), {"none": 0.2}),
}

ORIGIN, VIA, DESTINATION = [0, 0, 1.0, 0.2], [5, 6, 0.8, 0.1], [12, 6, 0.2, 0.1]
OF_ORIGIN, OF_VIA, OF_DESTINATION = (np.diag(v) for v in ([0.5, 0.5, 0.2, 0.2], [0.2, 0.2, 0.3, 0.3], [0.3, 0.4, 0.1, 0.1]))
INDEPENDENT, CORRELATED = block_diag(OF_ORIGIN, OF_DESTINATION), block_diag(OF_ORIGIN, OF_DESTINATION)
for i, j, covariance in ((0, 4, 0.25), (1, 5, -0.2), (2, 4, 0.05)):
    CORRELATED[i, j] = CORRELATED[j, i] = covariance
PLANE = {"dimensions": 2, "step": 1.0, "density": 0.05, "noise": 0.2}
ENDPOINTS = {"last": 12, "pins": [0, 12], "mean": ORIGIN + DESTINATION}
WAYPOINT = {"last": 14, "pins": [0, 6, 14], "mean": ORIGIN + VIA + DESTINATION}
LINE = {"dimensions": 1, "step": 0.5, "density": 0.4, "noise": 0.3, "last": 10, "pins": [0, 10], "mean": [0, 1, 4, 0]}

# a note, seed; the pinned states' covariance and the measured steps
SEQUENCES = {
    "cm-independent": (
        ("independent endpoints, G_{0,N} = 0", 1),
        {**PLANE, **ENDPOINTS, "covariance": INDEPENDENT, "steps": [1, 2, 3, 4, 5]},
    ),
    "cm-correlated": (
        ("origin and destination correlated", 2),
        {**PLANE, **ENDPOINTS, "covariance": CORRELATED, "steps": [0, 1, 2, 3, 4, 5, 6]},
    ),
    "cm-waypoint": (
        ("one waypoint at step 6", 3),
        {**PLANE, **WAYPOINT, "covariance": block_diag(OF_ORIGIN, OF_VIA, OF_DESTINATION), "steps": [1, 2, 3, 4]},
    ),
    "cm-irregular": (
        ("steps 2, 5, 6 are not measured", 4),
        {**LINE, "covariance": np.diag([0.5, 0.2, 0.3, 0.1]), "steps": [1, 3, 4, 7]},
    ),
}

# how each kind is made, what of, and how far its file is indented
KINDS = [(movements.case, MOVEMENTS, 1), (pointing.case, POINTING, None), (sequences.case, SEQUENCES, 1)]


def plain(value):
    """JSON has no infinity: null is written for it."""
    if isinstance(value, dict):
        return {key: plain(item) for key, item in value.items()}
    if isinstance(value, list):
        return [plain(item) for item in value]
    return None if isinstance(value, float) and not isfinite(value) else value


def difference(found, expected):
    """The largest difference of numbers, relative to 1 + their magnitude; infinite where anything else differs."""
    if isinstance(found, dict) and isinstance(expected, dict):
        found, expected = ([key for pair in sorted(value.items()) for key in pair] for value in (found, expected))
    if isinstance(found, list) and isinstance(expected, list) and len(found) == len(expected):
        return max((difference(*pair) for pair in zip(found, expected)), default=0.0)
    if found == expected:
        return 0.0
    numbers = all(isinstance(value, (int, float)) for value in (found, expected))
    return abs(found - expected) / (1 + abs(expected)) if numbers else inf


def main(arguments):
    check = "--check" in arguments
    wanted = [name for name in arguments if name != "--check"]
    known = {name for _, cases, _ in KINDS for name in cases}
    if not set(wanted) <= known:
        sys.exit(f"no case is named {', '.join(sorted(set(wanted) - known))}: there are {', '.join(sorted(known))}")
    worst = 0.0
    for make, cases, indent in KINDS:
        for name, (positional, named) in cases.items():
            if wanted and name not in wanted:
                continue
            file = FOLDER / f"{name}.json"
            text = json.dumps(plain(make(name, *positional, **named)), indent=indent)
            if not check:
                file.write_text(text)
                print(name)
                continue
            there = file.read_text()
            off = difference(json.loads(text), json.loads(there))
            worst = max(worst, off)
            print(f"{name}: {'the same bytes' if text == there else f'differs by {off:.1e}'}")
    if worst > TOLERANCE:
        sys.exit(f"differs by {worst:.1e}, more than {TOLERANCE:.0e}")


main(sys.argv[1:])
