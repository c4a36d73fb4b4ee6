//! `singleFilter` and `singleFilterApproximate`: Ardeshiri's predictor, (12) exactly and (15), Table 1.
//!
//! One Kalman filter with a fixed-point smoother of `x_1` gives `q(x_1, z)`, `z = G~ x_T`, for every node, (13)-(14). Then
//! ```text
//! p(y_1:k | D, T) = q(y_1:k) integral N(z; a, S) q(x_1, z) / f(z | x_1) dx_1 dz                                    (12)
//! ```
//! is a Gaussian integral. With `q(x_1, z)` whitened by its root, `[x_1; z] = [m; c] + L xi`, its exponent is
//! `-(xi'(I + A_S - A_f) xi)/2 + ...`: no covariance of `q` is inverted, which matters as the two densities of `z` given
//! `x_1` nearly cancel early on. (15) takes the denominator `f(z | x_1)` as constant.
//!
//! Table 1, line 12 of the paper prints `(I - K) P` for the corrected covariance; it is `(I - K C) P`, here as a root's square.
//!
//! ```
//! use whither::{Predictor, Scenario};
//! // a random walk seen at 0 and, after one of two seconds, at 1, on its way to N(4, 3); every noise is 1
//! let scenario: Scenario = serde_json::from_str(r#"{
//!     "method": "singleFilter", "arrival": { "type": "discrete", "times": [2], "weights": [1] },
//!     "motion": { "type": "brownian", "dimensions": 1, "noise": 1 }, "observation": { "noise": 1 },
//!     "destinations": [{ "id": "there", "mean": [4], "covariance": [[3]] }]
//! }"#).unwrap();
//! let mut predictor = Predictor::new(&scenario).unwrap();
//! predictor.observe(0.0, &[0.0]).unwrap();
//! predictor.observe(1.0, &[1.0]).unwrap();
//! // (12) is what the bridge says: y_2 = 1 is of N(2, 5/2)
//! let expected = -0.5 * (5.0 * std::f64::consts::PI).ln() - 0.2;
//! assert!((predictor.log_likelihoods()[0] - expected).abs() < 1e-13);
//! ```

use super::{Likelihood, Scene};
use crate::math::gaussian::{Factor, LN_2_PI, propagate, root, triangularise};
use crate::math::product::product;
use crate::model::endpoint::Endpoint;
use nalgebra::{DMatrix, DVector};

/// The exact engine, (12); it keeps nothing beyond the filter.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct SingleFilter;

/// The approximate engine, (15); it keeps nothing beyond the filter.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct SingleFilterApproximate;

impl Likelihood for SingleFilterApproximate {
    fn log_likelihoods(&self, scene: &Scene<'_>, table: &mut [f64]) {
        table.fill(f64::NEG_INFINITY);
        let covariance = scene.filter.current_covariance();
        for node in scene.nodes_ahead(scene.elapsed) {
            let endpoint = Endpoint::after(scene.motion, node.remaining, node.covariance.nrows());
            let predicted = propagate(&endpoint.matrix, &covariance, &(&endpoint.noise + &node.covariance));
            let Some(density) = Factor::new(predicted) else { continue };
            for &i in &node.group.members {
                let i = i as usize;
                let error = scene.endpoint_error(i, &endpoint, &scene.filter.mean(i));
                table[scene.plan.rows[i] + node.index] = scene.filter.evidence(i) + density.log_density(&error);
            }
        }
    }

    fn boxed(&self) -> Box<dyn Likelihood> {
        Box::new(*self)
    }
}

impl Likelihood for SingleFilter {
    fn log_likelihoods(&self, scene: &Scene<'_>, table: &mut [f64]) {
        table.fill(f64::NEG_INFINITY);
        for node in scene.nodes_ahead(scene.elapsed) {
            let length = node.covariance.nrows();
            let now = Endpoint::after(scene.motion, node.remaining, length);
            let start = Endpoint::after(scene.motion, node.since_first, length);
            let Some(integral) = Integral::new(scene, &now, &start, &node.covariance) else { continue };
            for &i in &node.group.members {
                let i = i as usize;
                let smoothed = scene.filter.smoothed_start(i).mean;
                // a - c and c - (the denominator's prediction of z from the smoothed start)
                let endpoint = scene.endpoint_error(i, &now, &scene.filter.mean(i));
                let denominator = scene.endpoint_error(i, &start, &smoothed) - &endpoint;
                table[scene.plan.rows[i] + node.index] =
                    scene.filter.evidence(i) + integral.log(&endpoint, &denominator);
            }
        }
    }

    fn boxed(&self) -> Box<dyn Likelihood> {
        Box::new(*self)
    }
}

/// The integral of (12) for one node and one kind of endpoint.
struct Integral {
    /// Root of `q(z)` rows: `z = c + ends xi`.
    ends: DMatrix<f64>,
    /// `z - f's prediction = r + gap xi`.
    gap: DMatrix<f64>,
    endpoint: Factor,
    denominator: Factor,
    precision: Factor,
    log_constant: f64,
}

impl Integral {
    fn new(scene: &Scene<'_>, now: &Endpoint, start: &Endpoint, covariance: &DMatrix<f64>) -> Option<Self> {
        let (s, l) = (scene.filter.states, covariance.nrows());
        // q(x_1, z), (14)
        let mut both = DMatrix::zeros(s + l, 2 * s);
        both.view_mut((0, 0), (s, s)).fill_with_identity();
        both.view_mut((s, s), (l, s)).copy_from(&now.matrix);
        let mut array = DMatrix::zeros(s + l, 2 * s + l);
        array.columns_mut(0, 2 * s).copy_from(&product(&both, &scene.filter.root));
        array.view_mut((s, 2 * s), (l, l)).copy_from(&root(&now.noise));
        let root = triangularise(array);
        let ends = root.rows(s, l).into_owned();
        let gap = &ends - product(&start.matrix, &root.rows(0, s).into_owned());
        let endpoint = Factor::new(covariance.clone())?;
        let denominator = Factor::new(start.noise.clone())?;
        let mut precision = product(&ends.transpose(), &endpoint.solve(&ends));
        precision -= product(&gap.transpose(), &denominator.solve(&gap));
        for i in 0..s + l {
            precision[(i, i)] += 1.0;
        }
        crate::math::gaussian::symmetrise(&mut precision);
        let precision = Factor::new(precision)?;
        // the precision's log normaliser counts (s + l) ln(2 pi) / 2 that the integral over xi does not
        let log_constant = endpoint.log_normaliser() - denominator.log_normaliser() + precision_log(&precision, s + l);
        Some(Self { ends, gap, endpoint, denominator, precision, log_constant })
    }

    /// The logarithm of the integral over `q(y_2:k | y_1)`, for `endpoint = a - c` and `denominator = c - f's prediction`.
    fn log(&self, endpoint: &DVector<f64>, denominator: &DVector<f64>) -> f64 {
        let column = |v: &DVector<f64>| DMatrix::from_column_slice(v.len(), 1, v.as_slice());
        let (b, r) = (column(endpoint), column(denominator));
        let (solved_b, solved_r) = (self.endpoint.solve(&b), self.denominator.solve(&r));
        let linear = product(&self.ends.transpose(), &solved_b) + product(&self.gap.transpose(), &solved_r);
        let quadratic = linear.dot(&self.precision.solve(&linear));
        self.log_constant + 0.5 * (quadratic + r.dot(&solved_r) - b.dot(&solved_b))
    }
}

/// `-ln sqrt(det precision)`.
fn precision_log(precision: &Factor, n: usize) -> f64 {
    precision.log_normaliser() + 0.5 * n as f64 * LN_2_PI
}
