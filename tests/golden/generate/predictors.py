"""The predictors of the papers, each written from its equations for one destination and one arrival time.

Slow on purpose: nothing is shared between destinations, arrival times or methods that a fast implementation would share, except
the Kalman filter. Times count from the first observation; T is an arrival time on that clock. Every method returns
log p(y_2:k | y_1, D_i, T) for k = 1..K, minus infinity from the observation on that comes at T or later.
"""
from functools import cache
from math import inf

import numpy as np
from gaussian import condition, log_density, log_sum_exp, motion
from scipy.linalg import block_diag


class Endpoint:
    """A destination: G~ x_T ~ N(mean, covariance), with G~ the first components of the state."""

    def __init__(self, given, model):
        self.mean, self.covariance = np.array(given["mean"], float), np.array(given["covariance"], float)
        self.centre = self.mean[: model.dimensions]
        self.selector = np.eye(model.states)[: len(self.mean)]
        self.model = model

    def arrival_over(self, length):
        """B, m, C with G~ x_T ~ N(B x + m, C) for a state x `length` seconds before T."""
        F, M, Q = self.model.step(length, self.centre)
        return self.selector @ F, self.selector @ M, self.selector @ Q @ self.selector.T


class Movement:
    """The model and the observations of one case."""

    def __init__(self, case):
        self.model = motion(case["motion"])
        s, d = self.model.states, self.model.dimensions
        self.observe = np.eye(s)[:d]
        noise = np.array(case["observation"]["noise"], float)
        self.noise = noise if noise.ndim == 2 else np.diag(np.broadcast_to(noise, d) ** 2)
        rows = np.array(case["observations"], float)
        self.times, self.positions = rows[:, 0] - rows[0, 0], rows[:, 1:]
        mean, covariance = (np.array(case["initial"][key], float) for key in ("mean", "covariance"))
        self.first = condition(mean, covariance, self.observe, self.positions[0], self.noise)[:2]
        self.endpoints = [Endpoint(given, self.model) for given in case["destinations"]]

    def step(self, k, endpoint):
        """F, M, Q from observation k - 1 to k."""
        return self.model.step(self.times[k] - self.times[k - 1], endpoint.centre)

    def predicted(self, k, endpoint, mean, covariance):
        F, M, Q = self.step(k, endpoint)
        return F @ mean + M, F @ covariance @ F.T + Q

    @cache
    def filtered(self, endpoint):
        """(mean, covariance, log p(y_k | y_1:k-1)) of the Kalman filter for each k."""
        steps = [(*self.first, 0.0)]
        for k in range(1, len(self.times)):
            predicted = self.predicted(k, endpoint, *steps[-1][:2])
            steps.append(condition(*predicted, self.observe, self.positions[k], self.noise))
        return steps

    def accumulated(self, T, evidence):
        """The sums over 2..k of `evidence(k)`, as long as observation k comes before T."""
        logs = [0.0]
        for k in range(1, len(self.times)):
            logs.append(logs[-1] + evidence(k) if self.times[k] < T else -inf)
        return logs


def algorithm1(movement, endpoint, T):
    """Liang (10), (11): the endpoint's mean corrects the state predicted to t_k as a pseudo-observation of x_T."""
    steps = movement.filtered(endpoint)

    def evidence(k):
        state = movement.predicted(k, endpoint, *steps[k - 1][:2])
        B, m, C = endpoint.arrival_over(T - movement.times[k])
        mean, covariance, _ = condition(*state, B, endpoint.mean - m, C + endpoint.covariance)
        G = movement.observe
        return log_density(movement.positions[k], G @ mean, G @ covariance @ G.T + movement.noise)

    return movement.accumulated(T, evidence)


def algorithm2(movement, endpoint, T):
    """Liang (12), (13) with + M(h): it corrects the last state, then the noise of the step that follows."""
    steps = movement.filtered(endpoint)

    def evidence(k):
        F, M, Q = movement.step(k, endpoint)
        B, m, C = endpoint.arrival_over(T - movement.times[k - 1])
        mean, covariance, _ = condition(*steps[k - 1][:2], B, endpoint.mean - m, C + endpoint.covariance)
        B, m, C = endpoint.arrival_over(T - movement.times[k])
        gain = Q @ B.T @ np.linalg.inv(B @ Q @ B.T + C + endpoint.covariance)
        rest = np.eye(len(mean)) - gain @ B
        mean = F @ mean + M
        mean, covariance = mean + gain @ (endpoint.mean - B @ mean - m), rest @ F @ covariance @ F.T @ rest.T + rest @ Q
        G = movement.observe
        return log_density(movement.positions[k], G @ mean, G @ covariance @ G.T + movement.noise)

    return movement.accumulated(T, evidence)


def pseudo_observation(movement, endpoint, T):
    """The product of the prediction errors of Algorithm 1, telescoped: the filter's own evidence, times the density of the
    endpoint given y_1:k, over its density given y_1."""
    steps = movement.filtered(endpoint)

    def endpoint_density(k):
        mean, covariance, _ = steps[k]
        B, m, C = endpoint.arrival_over(T - movement.times[k])
        return log_density(endpoint.mean, B @ mean + m, B @ covariance @ B.T + C + endpoint.covariance)

    evidence = movement.accumulated(T, lambda k: steps[k][2])
    later = [total + endpoint_density(k) - endpoint_density(0) if total > -inf else -inf for k, total in enumerate(evidence)]
    return [0.0, *later[1:]]


def bridging(movement, endpoint, T):
    """The original bridging distributions: a Kalman filter of (x_k, G~ x_T), x_T independent of x_1."""
    s, l = movement.model.states, len(endpoint.mean)
    state = np.r_[movement.first[0], endpoint.mean], block_diag(movement.first[1], endpoint.covariance)
    observe = np.c_[movement.observe, np.zeros((movement.model.dimensions, l))]

    def evidence(k):
        nonlocal state
        F, M, Q = movement.step(k, endpoint)
        B, m, C = endpoint.arrival_over(T - movement.times[k])
        arrival = B @ Q @ B.T + C
        gain = np.linalg.solve(arrival, B @ Q).T
        rest = np.eye(s) - gain @ B
        transition = np.block([[rest @ F, gain], [np.zeros((l, s)), np.eye(l)]])
        noise = block_diag(Q - gain @ arrival @ gain.T, np.zeros((l, l)))
        mean = transition @ state[0] + np.r_[rest @ M - gain @ m, np.zeros(l)]
        covariance = transition @ state[1] @ transition.T + noise
        *state, evidence = condition(mean, covariance, observe, movement.positions[k], movement.noise)
        return evidence

    return movement.accumulated(T, evidence)


def smoothed_start(movement, endpoint):
    """The filter of (x_1, x_k): each step's joint mean and covariance, and log p(y_2:k | y_1)."""
    s = movement.model.states
    mean, covariance = movement.first
    joint, total = (np.r_[mean, mean], np.block([[covariance, covariance], [covariance, covariance]])), 0.0
    observe = np.c_[np.zeros((movement.model.dimensions, s)), movement.observe]
    steps = [(*joint, total)]
    for k in range(1, len(movement.times)):
        F, M, Q = movement.step(k, endpoint)
        transition = block_diag(np.eye(s), F)
        mean = transition @ joint[0] + np.r_[np.zeros(s), M]
        covariance = transition @ joint[1] @ transition.T + block_diag(np.zeros((s, s)), Q)
        *joint, evidence = condition(mean, covariance, observe, movement.positions[k], movement.noise)
        total += evidence
        steps.append((*joint, total))
    return steps


def single_filter(movement, endpoint, T):
    """Ardeshiri (12): p(y_2:k | y_1) times the integral over x_1 and x_T of
    p(x_1, x_T | y_1:k) N(G~ x_T; a, S) / p(G~ x_T | x_1), a Gaussian integral in closed form."""
    s, l, a = movement.model.states, len(endpoint.mean), endpoint.mean
    B1, m1, C1 = endpoint.arrival_over(T)
    # p(G~ x_T | x_1) = N(D (x_1, G~ x_T); m_1, C_1)
    D = np.c_[-B1, np.eye(l)]
    inverse = np.linalg.inv
    precision, start_precision = inverse(endpoint.covariance), inverse(C1)
    log_volume = lambda covariance: 0.5 * np.linalg.slogdet(2 * np.pi * covariance)[1]

    def density(joint, covariance, length):
        B, m, C = endpoint.arrival_over(length)
        transition = block_diag(np.eye(s), B)
        mean = transition @ joint + np.r_[np.zeros(s), m]
        covariance = transition @ covariance @ transition.T + block_diag(np.zeros((s, s)), C)
        joint_precision = inverse(covariance)
        information = joint_precision - D.T @ start_precision @ D
        information[s:, s:] += precision
        vector = joint_precision @ mean - D.T @ start_precision @ m1
        vector[s:] += precision @ a
        constant = -0.5 * mean @ joint_precision @ mean - log_volume(covariance)
        constant += -0.5 * a @ precision @ a - log_volume(endpoint.covariance)
        constant += 0.5 * m1 @ start_precision @ m1 + log_volume(C1)
        return constant + 0.5 * vector @ np.linalg.solve(information, vector) - 0.5 * np.linalg.slogdet(information / (2 * np.pi))[1]

    steps = smoothed_start(movement, endpoint)
    logs = [0.0]
    for (joint, covariance, total), time in list(zip(steps, movement.times))[1:]:
        logs.append(total + density(joint, covariance, T - time) if time < T else -inf)
    return logs


def single_filter_approximate(movement, endpoint, T):
    """Ardeshiri (15), Table 1: the denominator of (12) taken as constant."""
    total, logs = 0.0, [0.0]
    for (mean, covariance, evidence), time in list(zip(movement.filtered(endpoint), movement.times))[1:]:
        total += evidence
        if time >= T:
            logs.append(-inf)
            continue
        B, m, C = endpoint.arrival_over(T - time)
        logs.append(total + log_density(endpoint.mean, B @ mean + m, B @ covariance @ B.T + C + endpoint.covariance))
    return logs


METHODS = {
    "pseudoObservation": pseudo_observation,
    "algorithm1": algorithm1,
    "algorithm2": algorithm2,
    "bridging": bridging,
    "singleFilter": single_filter,
    "singleFilterApproximate": single_filter_approximate,
}


def quadrature(rule, points):
    """Nodes from 0 to 1 and weights that sum to 1."""
    if rule == "gaussLegendre":
        nodes, weights = np.polynomial.legendre.leggauss(points)
        return (nodes + 1) / 2, weights / 2
    weights = np.ones(points)
    if rule == "simpson":
        weights[1:-1:2], weights[2:-1:2] = 4, 2
    elif rule == "trapezoid":
        weights[0] = weights[-1] = 0.5
    else:
        raise ValueError(rule)
    return np.linspace(0, 1, points), weights / weights.sum()


def arrival_times(case, now):
    """The nodes of the arrival time and their prior weights, at time `now`."""
    arrival = case["arrival"]
    if arrival["type"] == "discrete":
        weights = np.array(arrival["weights"], float)
        return np.array(arrival["times"], float), weights / weights.sum()
    nodes, weights = quadrature(**case["quadrature"])
    nodes = arrival["from"] + (arrival["to"] - arrival["from"]) * nodes
    return (nodes + now if arrival["type"] == "horizon" else nodes), weights


def joint_logs(case, movement, method):
    """For each observation the nodes and log p(y_2:k, T_n | y_1, D_i), a row for each destination."""
    likelihood = lambda nodes: np.array([[method(movement, endpoint, T) for T in nodes] for endpoint in movement.endpoints])
    moving = case["arrival"]["type"] == "horizon"
    nodes, weights = arrival_times(case, 0.0)
    table = None if moving else likelihood(nodes)
    each = []
    for k, now in enumerate(movement.times):
        if moving:
            nodes, weights = arrival_times(case, now)
            table = likelihood(nodes)
        at = table[:, :, k] if k else np.zeros(table.shape[:2])
        each.append((nodes, at + np.log(weights)))
    return each


def normalised(logs):
    weights = np.exp(logs - logs.max())
    return weights / weights.sum()


def prior(case):
    weights = np.array([given.get("prior", 1.0) for given in case["destinations"]], float)
    return np.log(weights / weights.sum())


def state(movement, nodes, weights, at):
    """The state at time `at` from the last observation on: Liang (10) applied to the state predicted to that time, or to the
    arrival where that is earlier; mixed over destinations and arrival times, moments matched."""
    s, now = movement.model.states, movement.times[-1]
    mean, second = np.zeros(s), np.zeros((s, s))
    still = np.eye(s), np.zeros(s), np.zeros((s, s))
    for endpoint, row in zip(movement.endpoints, weights):
        last, spread, _ = movement.filtered(endpoint)[-1]
        for T, weight in zip(nodes, row):
            if weight == 0:
                continue
            until = min(at, T)
            F, M, Q = movement.model.step(until - now, endpoint.centre) if until > now else still
            predicted = F @ last + M, F @ spread @ F.T + Q
            selector = endpoint.selector
            B, m, C = endpoint.arrival_over(T - until) if T > until else (selector, np.zeros(len(selector)), np.zeros((len(selector),) * 2))
            one, covariance, _ = condition(*predicted, B, endpoint.mean - m, C + endpoint.covariance)
            mean += weight * one
            second += weight * (covariance + np.outer(one, one))
    covariance = second - np.outer(mean, mean)
    return {"mean": mean.tolist(), "covariance": ((covariance + covariance.T) / 2).tolist()}


def expected(case):
    """What must come out of a case."""
    movement, log_prior = Movement(case), prior(case)
    # the methods that accumulate cannot follow a horizon
    names = ["pseudoObservation"] if case["arrival"]["type"] == "horizon" else list(METHODS)
    out = {"logLikelihoods": {}, "probabilities": {}}
    for name in names:
        logs = np.array([[log_sum_exp(row) for row in joint] for _, joint in joint_logs(case, movement, METHODS[name])])
        out["logLikelihoods"][name] = logs.tolist()
        out["probabilities"][name] = [normalised(row + log_prior).tolist() for row in logs]
    nodes, joint = joint_logs(case, movement, pseudo_observation)[-1]
    weights = normalised(joint + log_prior[:, None])
    of_arrival = weights.sum(0)
    out["arrival"] = {"times": nodes.tolist(), "probabilities": of_arrival.tolist(), "mean": float((of_arrival * nodes).sum())}
    now, after = movement.times[-1], case["forecastAfter"]
    out["state"] = state(movement, nodes, weights, now)
    out["forecast"] = {"after": after, **state(movement, nodes, weights, now + after)}
    agree(case["name"], out["logLikelihoods"])
    return out


def agree(name, logs):
    """The identities between the methods of one family, which share no more than the filter."""
    pairs = [("algorithm1", "algorithm2"), ("algorithm1", "pseudoObservation"), ("bridging", "singleFilter")]
    for one, other in pairs if "bridging" in logs else []:
        a, b = np.array(logs[one]), np.array(logs[other])
        known = np.isfinite(a) | np.isfinite(b)
        difference = (np.abs(a[known] - b[known]) / (1 + np.abs(a[known]))).max()
        assert difference < 1e-7, f"{name}: {one} and {other} differ by {difference:e}"
