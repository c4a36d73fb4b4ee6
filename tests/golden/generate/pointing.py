"""The pointing model (docs/pointing.md): a Kalman filter whose noise grows with the speed; for each target a closed-form density
of the endpoint over noise scales and times to go, against the density given the start alone; and the direction from the start.

Two dimensions, pixels and seconds. `CONSTANTS` is what a scenario states under the keys of the same names.
"""
from math import cos, exp, log, log2, pi, sin, sqrt

import numpy as np

CONSTANTS = {
    "noise": 1100.0,
    "speedNoise": 2.0,
    "observation": 0.5,
    "velocity": 50.0,
    "pointing": {
        "noise": [467.0, 4200.0],
        "alongNoise": 3.0,
        "acrossNoise": 1.0,
        "timeToGo": {"from": 0.04, "to": 1.2, "points": 7, "median": 0.2, "spread": 0.8, "speedExponent": -0.25},
        "start": {"exponent": 1.0, "core": 8.0, "reach": 1500.0},
        "direction": {"power": 2.0, "core": 0.16, "wide": 0.6, "distance": 60.0, "time": 0.43},
        "power": {"from": 0.3, "to": 1.9, "time": 0.21},
        "near": 1.5,
        "noneGain": 1.7,
        "uniform": 0.015,
    },
}


class Filter:
    """Constant velocity on two axes alike: one mean for each, one 2 by 2 covariance (pp, pv; pv, vv) for both."""

    def __init__(self, time, position):
        self.time, self.position, self.velocity = time, position.copy(), np.zeros(2)
        self.pp, self.pv, self.vv = CONSTANTS["observation"] ** 2, 0.0, CONSTANTS["velocity"] ** 2

    def after(self, time, position):
        """The filter after one more observation."""
        new = Filter(time, position)
        h = max(time - self.time, 1e-4)
        q = CONSTANTS["noise"] ** 2 + CONSTANTS["speedNoise"] ** 2 * (self.velocity @ self.velocity)
        predicted = self.position + h * self.velocity
        pp = self.pp + 2 * h * self.pv + h * h * self.vv + q * h**3 / 3
        pv = self.pv + h * self.vv + q * h * h / 2
        vv = self.vv + q * h
        innovation = pp + CONSTANTS["observation"] ** 2
        gain = pp / innovation, pv / innovation
        new.position = predicted + gain[0] * (position - predicted)
        new.velocity = self.velocity + gain[1] * (position - predicted)
        new.pp, new.pv, new.vv = pp * (1 - gain[0]), pv * (1 - gain[0]), vv - gain[1] * pv
        return new

    def variance(self, R):
        """The variance of the position R seconds on, without noise on the way."""
        return self.pp + 2 * R * self.pv + R * R * self.vv


class Pointing:
    """The posterior of one movement towards targets (x, y, width, height)."""

    def __init__(self, targets, prior, none):
        self.constants = CONSTANTS["pointing"]
        self.centre, self.size = targets[:, :2], targets[:, 2:]
        # uniform over the box
        self.variance = self.size**2 / 12
        self.log_prior = np.log(prior / prior.sum()) + log(1 - none)
        self.log_none = log(none) if none > 0 else -np.inf
        nodes = self.constants["timeToGo"]
        self.R = np.exp(np.linspace(log(nodes["from"]), log(nodes["to"]), nodes["points"]))
        self.filter = None

    def observe(self, time, position):
        """Takes in one sample: afterwards there are `probabilities` and `none`."""
        if self.filter is not None and time == self.filter.time:
            # it replaces the one before it, which a movement may have begun with
            self.filter = self.previous
        if self.filter is None:
            self._begin(time, position)
            return
        self.previous, self.filter = self.filter, self.filter.after(time, position)
        power = self.constants["power"]
        g = power["to"] - (power["to"] - power["from"]) * exp(-(time - self.start_time) / power["time"])
        log_ratio = self._log_endpoint() - self.log_start
        self._finish(g * log_ratio + self._direction() + self.log_near, self.constants["noneGain"] * (g - power["from"]))

    def _begin(self, time, position):
        self.previous, self.filter = None, Filter(time, position)
        self.start_time, self.start = time, position
        start, near = self.constants["start"], self.constants["near"]
        core, power = start["core"] ** 2, 1 - start["exponent"] / 2
        # the integral of the density over a disc
        log_area = log(pi / power * ((start["reach"] ** 2 + core) ** power - core**power))
        away = self.centre - position
        self.log_start = -0.5 * start["exponent"] * np.log((away**2).sum(1) + core) - log_area
        # in widths and heights, and one pixel
        square = ((away / self.size) ** 2).sum(1) + 1 / self.size.prod(1)
        self.log_near = np.log(square / (square + near**2))
        self._finish(self.log_near, 0.0)

    def _log_endpoint(self):
        """ln N_i: a mixture over noise scales and times to go R of Gaussians in the frame of the velocity."""
        constants, now, R = self.constants, self.filter, self.R
        speed = sqrt(now.velocity @ now.velocity)
        u = now.velocity / speed if speed > 1e-9 else np.array([1.0, 0.0])
        nodes = constants["timeToGo"]
        median = log(nodes["median"]) + nodes["speedExponent"] * log((speed + 50) / 1000)
        log_weight = -0.5 * ((np.log(R) - median) / nodes["spread"]) ** 2
        log_weight = log_weight - np.logaddexp.reduce(log_weight)
        away = self.centre - now.position
        # axes: target, noise scale, node
        along = (away @ u)[:, None, None] - speed * R
        across = (away[:, 0] * u[1] - away[:, 1] * u[0])[:, None, None]
        scale = (np.array(constants["noise"]) ** 2)[:, None]

        def variance(noise, of_target):
            moved = now.variance(R) + (scale + (noise * speed) ** 2) * R**3 / 3
            return moved + of_target[:, None, None]

        v_along = variance(constants["alongNoise"], self.variance @ (u * u))
        v_across = variance(constants["acrossNoise"], self.variance @ (u * u)[::-1])
        # of along and across together: none for squares
        v_both = (u[0] * u[1] * (self.variance[:, 0] - self.variance[:, 1]))[:, None, None]
        det = v_along * v_across - v_both**2
        square = (v_across * along**2 - 2 * v_both * along * across + v_along * across**2) / det
        logs = -0.5 * (square + np.log(det)) - log(2 * pi) + log_weight - log(len(scale))
        top = logs.max((1, 2))
        densities = np.exp(logs - top[:, None, None])
        of_node = densities.sum(1)
        # p(R_n | target)
        self.node = of_node / of_node.sum(1, keepdims=True)
        return top + np.log(densities.sum((1, 2)))

    def _direction(self):
        """B_i: the angle at the start between where the pointer is and the target, heavy-tailed."""
        constants, now = self.constants["direction"], self.filter
        moved, away = now.position - self.start, self.centre - self.start
        net, speed = sqrt(moved @ moved), sqrt(now.velocity @ now.velocity)
        weight = net / (net + constants["distance"] + constants["time"] * speed)
        angle = np.arctan2(np.abs(moved[0] * away[:, 1] - moved[1] * away[:, 0]), away @ moved) ** 2
        # the angular variance of the box from the start
        box = (self.variance * away[:, ::-1] ** 2).sum(1) / ((away**2).sum(1) + 1) ** 2
        wide, core = (np.log1p(angle / (constants[key] ** 2 + box)) for key in ("wide", "core"))
        return constants["power"] * weight * (2 * wide - core)

    def _finish(self, logs, none):
        logs = np.append(logs + self.log_prior, self.log_none + none)
        posterior = np.exp(logs - logs.max())
        posterior /= posterior.sum()
        self.none, uniform = posterior[-1], self.constants["uniform"]
        self.probabilities = (1 - uniform) * posterior[:-1] + uniform * (1 - self.none) / (len(posterior) - 1)

    def arrival(self):
        weights = self.probabilities @ self.node
        return self.filter.time + self.R, weights / weights.sum()


def case(name, seed, layout, count, *, repeats=False, none=0.0):
    """A minimum-jerk movement with a bow and noise, to one of `count` targets."""
    draw = np.random.default_rng(seed)
    if layout == "grid":
        targets = [[140 + 160 * (i % 7), 160 + 190 * (i // 7), 96, 96] for i in range(count)]
    elif layout == "sizes":
        bounds = (0, 1600), (0, 900), (16, 200), (16, 120)
        targets = [[float(draw.uniform(*bound)) for bound in bounds] for _ in range(count)]
    else:
        angles = [2 * pi * i / count for i in range(count)]
        targets = [[800 + 300 * cos(angle), 450 + 300 * sin(angle), 24, 24] for angle in angles]
    true = int(draw.integers(count))
    goal = np.array(targets[true][:2])
    start = np.array([800.0, 450.0]) if layout == "ring" else draw.uniform([100, 100], [1400, 800])
    way = goal - start
    distance = np.hypot(*way)
    duration = 0.25 + 0.15 * log2(distance / 60 + 1)
    times = [0.0]
    while times[-1] < duration:
        times.append(times[-1] + float(draw.choice([0.004, 0.008, 0.016, 0.0167])))
    times = np.array(times)
    share = np.clip(times / duration, 0, 1)
    done = 10 * share**3 - 15 * share**4 + 6 * share**5
    bow = draw.normal(0, 0.04) * distance * np.sin(pi * done)
    positions = start + way * done[:, None] + np.array([-way[1], way[0]]) / distance * bow[:, None]
    positions = np.round(positions + draw.normal(0, 0.6, (len(times), 2)), 2)
    if repeats:
        positions[5] = positions[4] = positions[3]
        times[9] = times[8]
    prior = draw.uniform(0.5, 2, count) if layout == "sizes" else np.ones(count)
    model = Pointing(np.array(targets, float), prior, none)
    probabilities, nones = [], []
    for time, position in zip(times.tolist(), positions):
        model.observe(time, position)
        probabilities.append(model.probabilities.tolist())
        nones.append(float(model.none))
    nodes, weights = model.arrival()
    begin = 3.5
    boxes = zip(targets, prior.tolist())
    return {
        "name": name,
        "scenario": {
            "method": "pointing",
            "none": none,
            "motion": {
                "type": "constantVelocity",
                "dimensions": 2,
                "noise": CONSTANTS["noise"],
                "speedNoise": CONSTANTS["speedNoise"],
            },
            "observation": {"noise": CONSTANTS["observation"]},
            "initial": {"velocity": CONSTANTS["velocity"]},
            "pointing": CONSTANTS["pointing"],
            "destinations": [
                {"id": f"t{i}", "center": box[:2], "size": box[2:], "prior": prior} for i, (box, prior) in enumerate(boxes)
            ],
        },
        "true": true,
        "observations": np.c_[times + begin, positions].tolist(),
        "expected": {
            "probabilities": probabilities,
            "none": nones,
            "arrival": {
                "times": (nodes + begin).tolist(),
                "probabilities": weights.tolist(),
                "mean": float(weights @ nodes) + begin,
            },
        },
    }
