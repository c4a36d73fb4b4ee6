"""Gaussian densities and the linear motion models, in plain numpy."""
from math import log, pi

import numpy as np
from scipy.linalg import block_diag, expm


def log_density(x, mean, covariance):
    """log N(x; mean, covariance), by a Cholesky factor."""
    factor = np.linalg.cholesky(covariance)
    white = np.linalg.solve(factor, x - mean)
    return -0.5 * white @ white - np.log(np.diag(factor)).sum() - 0.5 * len(white) * log(2 * pi)


def condition(mean, covariance, matrix, observed, noise):
    """The density of x given `observed = matrix x + v`, `v ~ N(0, noise)`, and the log evidence of what was observed."""
    innovation = matrix @ covariance @ matrix.T + noise
    gain = np.linalg.solve(innovation, matrix @ covariance).T
    rest = np.eye(len(mean)) - gain @ matrix
    evidence = log_density(observed, matrix @ mean, innovation)
    # Joseph's form: symmetric and positive whatever the rounding
    return mean + gain @ (observed - matrix @ mean), rest @ covariance @ rest.T + gain @ noise @ gain.T, evidence


def log_sum_exp(logs):
    largest = logs.max()
    return largest if not np.isfinite(largest) else largest + log(np.exp(logs - largest).sum())


class Motion:
    """dx = (A x + b + B c) dt + dw, E[dw dw'] = W dt, with c the centre of a destination.

    The state has all positions first, then all velocities, then all accelerations.
    """

    def __init__(self, drift, diffusion, offset=None, gain=None, dimensions=2):
        self.drift, self.diffusion = np.array(drift, float), np.array(diffusion, float)
        self.states, self.dimensions = len(self.drift), dimensions
        self.offset = np.zeros(self.states) if offset is None else np.array(offset, float)
        self.gain = np.zeros((self.states, dimensions)) if gain is None else np.array(gain, float)
        self.known = {}

    def step(self, length, centre):
        """F, M, Q of x_k = F x_{k-1} + M + e, e ~ N(0, Q), over `length` seconds: Van Loan's matrix exponential."""
        key = length, tuple(centre)
        if key not in self.known:
            self.known[key] = self._van_loan(length, self.offset + self.gain @ centre)
        return self.known[key]

    def _van_loan(self, length, input):
        s = self.states
        affine = np.zeros((s + 1, s + 1))
        affine[:s, :s], affine[:s, s] = self.drift, input
        affine = expm(affine * length)
        paired = np.block([[-self.drift, self.diffusion], [np.zeros((s, s)), self.drift.T]])
        paired = expm(paired * length)
        noise = paired[s:, s:].T @ paired[:s, s:]
        return affine[:s, :s], affine[:s, s], (noise + noise.T) / 2


def motion(given):
    """The model of a scenario's `motion`."""
    d, kind = given["dimensions"], given["type"]
    one, nil = np.eye(d), np.zeros((d, d))
    if kind == "custom":
        return Motion(given["drift"], given["diffusion"], given.get("offset"), given.get("destinationGain"), d)
    density = np.diag(np.broadcast_to(np.array(given["noise"], float), d) ** 2)
    if kind == "brownian":
        return Motion(nil, density, dimensions=d)
    if kind == "meanReverting":
        return Motion(-given["rate"] * one, density, gain=given["rate"] * one, dimensions=d)
    if kind == "constantVelocity":
        return Motion(np.block([[nil, one], [nil, nil]]), block_diag(nil, density), dimensions=d)
    if kind == "constantAcceleration":
        drift = np.block([[nil, one, nil], [nil, nil, one], [nil, nil, nil]])
        return Motion(drift, block_diag(nil, nil, density), dimensions=d)
    damping = given["damping"]
    if kind == "integratedOrnsteinUhlenbeck":
        reverted = np.array(given.get("drift", [0.0] * d), float)
        offset = np.r_[np.zeros(d), damping * reverted]
        return Motion(np.block([[nil, one], [nil, -damping * one]]), block_diag(nil, density), offset, dimensions=d)
    if kind == "equilibriumRevertingVelocity":
        stiffness = given["stiffness"]
        drift = np.block([[nil, one], [-stiffness * one, -damping * one]])
        return Motion(drift, block_diag(nil, density), gain=np.vstack([nil, stiffness * one]), dimensions=d)
    raise ValueError(kind)
