"""The movements of the golden cases: drawn, and given to `predictors.py`."""
import numpy as np
from gaussian import motion as model_of
from predictors import expected


def case(name, seed, motion, endpoint, arrival, quadrature, *, destinations=4, scale=1.0, deviation=0.05, correlated=False, repeats=False):
    """A minimum-jerk movement of 12 noisy observations to the first of some destinations, whose means have `endpoint`
    components. With `correlated` the covariances are full, with `repeats` two observations are at one time."""
    count, forecast_after, clock = 12, 0.15, 7.0
    draw = np.random.default_rng(seed)
    d, s = motion["dimensions"], model_of(motion).states
    times = np.r_[0, np.cumsum(draw.uniform(0.05, 0.2, count - 1))]
    if repeats:
        times[5] = times[4]
    place = lambda: draw.uniform(-3, 3, d) * scale
    goal, start = place(), place()
    share = np.clip(times / (times[-1] * 1.6), 0, 1)
    done = 10 * share**3 - 15 * share**4 + 6 * share**5
    positions = start + (goal - start) * done[:, None] + draw.normal(0, deviation * scale, (count, d))

    def destination(i):
        mean = np.zeros(endpoint)
        mean[:d] = place() if i else goal
        deviations = np.r_[np.full(d, 0.15 * scale), np.full(endpoint - d, 0.6 * scale)]
        covariance = np.diag(deviations**2 * draw.uniform(0.5, 1.5, endpoint))
        if correlated:
            factor = draw.normal(size=(endpoint, endpoint)) * 0.05 * scale
            covariance = covariance + factor @ factor.T
        return {"id": f"d{i}", "mean": mean.tolist(), "covariance": covariance.tolist(), "prior": float(draw.uniform(0.5, 2))}

    boxes = [destination(i) for i in range(destinations)]
    noise = deviation * scale
    if correlated:
        noise = (noise**2 * (np.eye(d) + 0.3 * (np.ones((d, d)) - np.eye(d)))).tolist()
    initial = {
        "mean": np.r_[positions[0] + draw.normal(0, 0.1 * scale, d), np.zeros(s - d)].tolist(),
        "covariance": np.diag(np.r_[np.full(d, 0.3 * scale), np.full(s - d, 2.0 * scale)] ** 2).tolist(),
    }
    made = {
        "name": name,
        "motion": motion,
        "observation": {"noise": noise},
        "initial": initial,
        "arrival": arrival,
        "destinations": boxes,
        "observations": np.c_[times + clock, positions].tolist(),
        "forecastAfter": forecast_after,
    }
    if quadrature:
        made["quadrature"] = quadrature
    return {**made, "expected": expected(made)}
