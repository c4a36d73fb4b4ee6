"""Literal Algorithm 1 of Liang et al. in numpy: for each destination and arrival time a Kalman filter of its own, corrected
with the observation and with the pseudo-observation of the endpoint, position and velocity. Constant velocity in two
dimensions.

Reads { scenario, observations } from the file that is named, prints JSON: the seconds of processor time that one observation
takes, and the probabilities at the end."""
import json
import sys
import time

import numpy as np

given = json.load(open(sys.argv[1]))
scenario, observations = given["scenario"], given["observations"]
EYE = np.eye(2)
NOISE, DEVIATION = scenario["motion"]["noise"], scenario["observation"]["noise"]
G = np.hstack([EYE, np.zeros((2, 2))])
V = DEVIATION**2 * EYE
ENDPOINTS = [
    (np.array(d["center"] + [0.0, 0.0]), np.diag(np.append(np.square(d["size"]) / 12, [d["endVelocity"] ** 2] * 2)))
    for d in scenario["destinations"]
]
POINTS = scenario["quadrature"]["points"]
ARRIVALS = np.linspace(scenario["arrival"]["from"], scenario["arrival"]["to"], POINTS)
SIMPSON = np.array([1.0] + [4.0, 2.0] * ((POINTS - 3) // 2) + [4.0, 1.0])


def transition(h):
    """(1)"""
    return np.kron([[1, h], [0, 1]], EYE), NOISE**2 * np.kron([[h**3 / 3, h**2 / 2], [h**2 / 2, h]], EYE)


def log_density(error, covariance):
    return -0.5 * (error @ np.linalg.solve(covariance, error) + np.linalg.slogdet(2 * np.pi * covariance)[1])


def correct(mean, covariance, matrix, noise, value):
    """The Kalman correction: of the observation, and (10) of the endpoint."""
    spread = matrix @ covariance @ matrix.T + noise
    gain = np.linalg.solve(spread, matrix @ covariance).T
    return mean + gain @ (value - matrix @ mean), covariance - gain @ spread @ gain.T


first, spent = observations[0][0], 0.0
mean = np.array(observations[0][1:] + [0.0, 0.0])
covariance = np.diag([DEVIATION**2] * 2 + [scenario["initial"]["velocity"] ** 2] * 2)
log_likelihood = np.zeros((len(ENDPOINTS), POINTS))
for (before, *_), (now, *position) in zip(observations, observations[1:]):
    y = np.array(position)
    start = time.process_time()
    F, Q = transition(now - before)
    mean, covariance = F @ mean, F @ covariance @ F.T + Q
    for i, (a, S) in enumerate(ENDPOINTS):
        for n, arrival in enumerate(ARRIVALS):
            # (10): the state now, given that it arrives there and then; (11): the density of the observation from it
            ahead, rest = transition(first + arrival - now)
            there, wide = correct(mean, covariance, ahead, rest + S, a)
            log_likelihood[i, n] += log_density(y - G @ there, G @ wide @ G.T + V)
    mean, covariance = correct(mean, covariance, G, V, y)
    # (6) and (3)
    top = log_likelihood.max()
    posterior = (np.exp(log_likelihood - top) * SIMPSON).sum(axis=1)
    posterior /= posterior.sum()
    spent += time.process_time() - start
print(json.dumps({"numpy": np.__version__, "seconds": spent / (len(observations) - 1), "probabilities": posterior.tolist()}))
