"""Conditionally Markov sequences (Rezaie and Li), by brute force on the joint Gaussian of all states.

A sequence induced by a Markov model moves between its pinned states as the Markov sequence does given these, while the pinned
states have any joint Gaussian density (Theorem 3.3). All N + 1 states are stacked into one Gaussian and conditioned by plain
linear algebra: no recursion is shared with an implementation that goes step by step.
"""
import numpy as np


def constant_velocity(dimensions, step, density):
    """F and Q over one step."""
    one, nil = np.eye(dimensions), np.zeros((dimensions, dimensions))
    F = np.block([[one, step * one], [nil, one]])
    return F, density * np.block([[step**3 / 3 * one, step**2 / 2 * one], [step**2 / 2 * one, step * one]])


def induced(F, Q, last, k):
    """G_{k,k-1}, G_{k,N} and G_k of Rezaie and Li (7) to (9), with one F and Q for all steps."""
    power, inverse = np.linalg.matrix_power, np.linalg.inv
    # the state at N given the one at k: N(M x_k, C)
    M = power(F, last - k)
    C = sum(power(F, last - n - 1) @ Q @ power(F, last - n - 1).T for n in range(k, last))
    noise = inverse(inverse(Q) + M.T @ inverse(C) @ M)
    destination = noise @ M.T @ inverse(C)
    return F - destination @ power(F, last - k + 1), destination, noise


def block(states, k):
    """Where the state of step k is among the stacked ones."""
    return slice(k * states, (k + 1) * states)


def stacked(F, Q, last, pins, mean, covariance):
    """The mean and covariance of the states x_0 to x_N, given those of the pinned ones."""
    s = len(F)
    # any Markov sequence with this F and Q will do: only its density given the pinned states counts
    marginal = [100 * np.eye(s)]
    for _ in range(last):
        marginal.append(F @ marginal[-1] @ F.T + Q)
    markov = np.zeros(((last + 1) * s,) * 2)
    for i in range(last + 1):
        for j in range(i, last + 1):
            cross = np.linalg.matrix_power(F, j - i) @ marginal[i]
            markov[block(s, j), block(s, i)], markov[block(s, i), block(s, j)] = cross, cross.T
    pinned = np.concatenate([np.arange(k * s, (k + 1) * s) for k in pins])
    free = np.setdiff1d(np.arange(len(markov)), pinned)
    of_pinned, crossed, of_free = (markov[np.ix_(a, b)] for a, b in ((pinned, pinned), (pinned, free), (free, free)))
    gain = np.linalg.solve(of_pinned, crossed).T
    rest = of_free - gain @ crossed
    all_mean, all_covariance = np.zeros(len(markov)), np.zeros_like(markov)
    all_mean[pinned], all_mean[free] = mean, gain @ mean
    carried = gain @ covariance
    all_covariance[np.ix_(pinned, pinned)] = covariance
    all_covariance[np.ix_(free, pinned)], all_covariance[np.ix_(pinned, free)] = carried, carried.T
    all_covariance[np.ix_(free, free)] = rest + carried @ gain.T
    return all_mean, (all_covariance + all_covariance.T) / 2


def measured(mean, covariance, matrix, position, noise):
    innovation = matrix @ covariance @ matrix.T + noise
    gain = np.linalg.solve(innovation, matrix @ covariance).T
    return mean + gain @ (position - matrix @ mean), covariance - gain @ innovation @ gain.T


def case(name, note, seed, *, dimensions, last, step, density, pins, mean, covariance, steps, noise):
    """A sequence that is drawn, and measured at some steps: its density after each of them, and what is predicted then."""
    draw = np.random.default_rng(seed)
    F, Q = constant_velocity(dimensions, step, density)
    s, mean, covariance = 2 * dimensions, np.array(mean, float), np.array(covariance, float)
    all_mean, all_covariance = stacked(F, Q, last, pins, mean, covariance)
    truth = draw.multivariate_normal(all_mean, all_covariance, method="eigh")

    def density_of(k):
        return {"mean": all_mean[block(s, k)].tolist(), "covariance": all_covariance[block(s, k), block(s, k)].tolist()}

    measurements, filtered = [], []
    for k in steps:
        position = truth[block(s, k)][:dimensions] + draw.normal(0, noise, dimensions)
        measurements.append({"step": k, "position": position.tolist()})
        observe = np.eye(len(all_mean))[block(s, k)][:dimensions]
        variance = np.eye(dimensions) * noise**2
        all_mean, all_covariance = measured(all_mean, all_covariance, observe, position, variance)
        filtered.append({"step": k, **density_of(k), "destination": density_of(last)})
    predicted = [{"step": k, **density_of(k)} for k in range(steps[-1] + 1, last + 1)]
    expected = {"filtered": filtered, "predicted": predicted}
    if pins == [0, last]:
        keys = "previous", "destination", "covariance"
        models = {k: induced(F, Q, last, k) for k in (1, last // 2, last - 1)}
        expected["model"] = [{"step": k, **dict(zip(keys, [G.tolist() for G in model]))} for k, model in models.items()]
    return {
        "name": name,
        "note": note,
        "motion": {"type": "constantVelocity", "dimensions": dimensions, "noise": float(np.sqrt(density))},
        "timeStep": step,
        "steps": last,
        "pins": pins,
        "pinnedMean": mean.tolist(),
        "pinnedCovariance": covariance.tolist(),
        "observation": {"noise": noise},
        "measurements": measurements,
        "expected": expected,
    }
