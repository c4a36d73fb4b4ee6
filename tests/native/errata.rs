//! The errors in the printed papers (design, 1.2): what is printed and what is right, each against something that does not
//! come from the formula.

use crate::support::predictor;
use nalgebra::{DMatrix, DVector, dmatrix, dvector};
use serde_json::json;

fn log_density(error: &DVector<f64>, covariance: &DMatrix<f64>) -> f64 {
    let squares = error.dot(&(covariance.clone().try_inverse().unwrap() * error));
    -0.5 * (squares + (covariance * std::f64::consts::TAU).determinant().ln())
}

/// Constant velocity on one axis under a constant acceleration `b`: `F(h)`, `M(h)`, `Q(h)`.
fn accelerated(h: f64, b: f64) -> (DMatrix<f64>, DVector<f64>, DMatrix<f64>) {
    let q = 4.0;
    (
        dmatrix![1.0, h; 0.0, 1.0],
        dvector![0.5 * b * h * h, b * h],
        dmatrix![q * h.powi(3) / 3.0, q * h * h / 2.0; q * h * h / 2.0, q * h],
    )
}

/// Liang (12)-(13) for the second observation as they are printed, or with `sign` in front of `M(h)` inside the brackets.
fn algorithm2(b: f64, sign: f64) -> f64 {
    let (step, rest, target, spread, noise) = (0.5, 1.5, 12.0, 2.0, 0.25);
    let (mu, sigma) = (dvector![1.0, 0.0], dmatrix![0.25, 0.0; 0.0, 9.0]);
    let ((f, m, q), (f_rest, m_rest, q_rest)) = (accelerated(step, b), accelerated(rest, b));
    let (f_all, m_all, q_all) = accelerated(step + rest, b);
    // (12)
    let selection = f_all.rows(0, 1).into_owned();
    let predicted = (&selection * &sigma * selection.transpose())[0] + q_all[(0, 0)] + spread;
    let gain = &sigma * selection.transpose() / predicted;
    let smoothed = &mu + &gain * (target - (&selection * &mu)[0] - m_all[0]);
    let smoothed_covariance = &sigma - &gain * &selection * &sigma;
    // (13)
    let selection = f_rest.rows(0, 1).into_owned();
    let gain = &q * selection.transpose() / ((&selection * &q * selection.transpose())[0] + q_rest[(0, 0)] + spread);
    let inner = (&selection * (&f * &smoothed + sign * &m))[0] + m_rest[0];
    let mean = &f * &smoothed + &m + &gain * (target - inner);
    let left = DMatrix::identity(2, 2) - &gain * &selection;
    let onward = &left * &f;
    let covariance = &onward * smoothed_covariance * onward.transpose() + left * q;
    log_density(&dvector![3.5 - mean[0]], &dmatrix![covariance[(0, 0)] + noise])
}

/// The same by the library's Algorithm 1, which has no such bracket.
fn algorithm1(b: f64) -> f64 {
    let mut predictor = predictor(&json!({
        "motion": {
            "type": "custom", "dimensions": 1,
            "drift": [[0, 1], [0, 0]], "offset": [0, b], "diffusion": [[0, 0], [0, 4]]
        },
        "observation": { "noise": 0.5 },
        "initial": { "velocity": 3 },
        "arrival": { "type": "discrete", "times": [2] },
        "method": "algorithm1",
        "destinations": [{ "id": "a", "mean": [12], "covariance": [[2]] }]
    }));
    predictor.observe(0.0, &[1.0]).unwrap();
    predictor.observe(0.5, &[3.5]).unwrap();
    predictor.log_likelihoods()[0]
}

#[test]
fn liangs_thirteenth_equation_has_a_wrong_sign() {
    // without M(h) there is no difference
    assert!((algorithm2(0.0, 1.0) - algorithm2(0.0, -1.0)).abs() < 1e-14);
    for b in [0.0, 3.0, -2.0] {
        let right = algorithm1(b);
        assert!((algorithm2(b, 1.0) - right).abs() < 1e-10, "{b}: {} {right}", algorithm2(b, 1.0));
        if b != 0.0 {
            assert!((algorithm2(b, -1.0) - right).abs() > 1e-3, "{b}: the printed sign agrees");
        }
    }
}

/// `-ln` of the integral of the root of the product of two densities, by summing; the distance of a density to itself is zero.
#[test]
fn liangs_bhattacharyya_distance_lacks_a_root() {
    let (mean, variance) = ([0.3, 1.1], [0.5, 3.0]);
    let root = |x: f64| {
        let density = |i: usize| log_density(&dvector![x - mean[i]], &dmatrix![variance[i]]);
        (0.5 * (density(0) + density(1))).exp()
    };
    let step = 1e-3;
    let expected = -((-20_000..20_000).map(|k| root(step * f64::from(k))).sum::<f64>() * step).ln();
    let distance = |denominator: fn(f64) -> f64, variance: [f64; 2]| {
        let between = 0.5 * (variance[0] + variance[1]);
        let squares = (mean[0] - mean[1]) * (mean[0] - mean[1]) / between;
        squares / 8.0 + 0.5 * (between / denominator(variance[0] * variance[1])).ln()
    };
    assert!((distance(f64::sqrt, variance) - expected).abs() < 1e-9);
    assert!((distance(|product| product, variance) - expected).abs() > 0.01);
    let itself = distance(|product| product, [variance[1]; 2]) - distance(f64::sqrt, [variance[1]; 2]);
    assert!((itself + 0.5 * 3f64.ln()).abs() < 1e-12, "as printed a density is away from itself");
}

/// `(I - K C) P` is the covariance of a state given an observation; `(I - K) P` has not even the dimensions, and where they
/// happen to agree (as many observed components as states) it is that covariance only for `C = I`.
#[test]
fn ardeshiris_twelfth_line_lacks_the_observation_matrix() {
    let (p, c, r) = (dmatrix![3.0, 1.0; 1.0, 2.0], dmatrix![2.0, 0.0; 1.0, 1.0], dmatrix![0.5, 0.1; 0.1, 0.7]);
    let inverse = |m: &DMatrix<f64>| m.clone().try_inverse().unwrap();
    // information form: what is known of x adds up
    let expected = inverse(&(inverse(&p) + c.transpose() * inverse(&r) * &c));
    let gain = &p * c.transpose() * inverse(&(&c * &p * c.transpose() + &r));
    let identity = DMatrix::identity(2, 2);
    assert!(((&identity - &gain * &c) * &p - &expected).amax() < 1e-12);
    assert!(((&identity - &gain) * &p - &expected).amax() > 0.1);
    let ours = whither::internals::condition(&p, &c, &r).unwrap();
    assert!((ours.covariance() - expected).amax() < 1e-12);
}

/// Rezaie and Li (12) with `x_k` on both sides would leave the state where it is only for `G = 0`; the sequence of (12) with
/// `x_{k-1}` has the variance that the bridge from 0 to its end has.
#[test]
fn rezaie_and_lis_twelfth_equation_steps_from_the_state_before() {
    // a random walk from 0 to z over four steps: x_k = (n - 1) / n x_{k-1} + z / n + e, var (n - 1) / n, n steps left
    let end = 5.0;
    let (mut mean, mut variance) = (0.0, 0.0);
    for (k, left) in [(1, 4.0), (2, 3.0), (3, 2.0)] {
        let bridge =
            whither::internals::Bridge::new(&dmatrix![1.0], &dmatrix![1.0], &dmatrix![1.0], &dmatrix![left - 1.0], 1)
                .unwrap();
        let (previous, destination) = (bridge.previous[0], bridge.destination[0]);
        mean = previous * mean + destination * end;
        variance = previous * previous * variance + bridge.covariance[0];
        // by hand: the bridge is at k/4 of the way, its variance k (4 - k) / 4
        let k = f64::from(k);
        assert!((mean - end * k / 4.0).abs() < 1e-12 && (variance - k * (4.0 - k) / 4.0).abs() < 1e-12);
        // as printed, x_k = G x_k + H z + e has this mean at every step
        let printed = destination * end / (1.0 - previous);
        assert!((printed - end).abs() < 1e-9, "the end itself, at every step");
    }
}
