//! `singleFilter` and `singleFilterApproximate`: Ardeshiri (12)-(15): (12) exactly, and (15), Table 1.
//!
//! One Kalman filter with a fixed-point smoother of `x_1` gives `q(x_1, z)`, `z = G~ x_T`, for every node, (13)-(14). Then
//! ```text
//! p(y_1:k | D, T) = q(y_1:k) integral N(z; a, S) q(x_1, z) / f(z | x_1) dx_1 dz                                    (12)
//! ```
//! is a Gaussian integral. With `q(x_1, z)` whitened by its root, `[x_1; z] = [m; c] + L xi`, its exponent is
//! `-(xi'(I + A_S - A_f) xi)/2 + ...`: no covariance of `q` is inverted, which matters as the two densities of `z` given
//! `x_1` nearly cancel early on. The same integrand, normalised, is the density of the states. (15) takes the denominator
//! `f(z | x_1)` as constant; its integrand is then that of Liang (10), and so are its states.
//!
//! Table 1, line 12 of the paper prints `(I - K) P` for the corrected covariance; it is `(I - K C) P`, here as a root's square.
//!
//! ```
//! use whither::{Predictor, Scenario};
//! // a random walk observed at 0 and, after one of two seconds, at 1, on its way to N(4, 3); every noise is 1
//! let scenario: Scenario = serde_json::from_str(r#"{
//!     "method": "singleFilter", "arrival": { "type": "discrete", "times": [2], "weights": [1] },
//!     "motion": { "type": "brownian", "dimensions": 1, "noise": 1 }, "observation": { "noise": 1 },
//!     "destinations": [{ "id": "there", "mean": [4], "covariance": [[3]] }]
//! }"#).unwrap();
//! let mut predictor = Predictor::new(&scenario);
//! predictor.observe(0.0, &[0.0]).unwrap();
//! predictor.observe(1.0, &[1.0]).unwrap();
//! // (12) equals the bridge: y_2 = 1 is of N(2, 5/2)
//! let expected = -0.5 * (5.0 * std::f64::consts::PI).ln() - 0.2;
//! assert!((predictor.log_likelihoods()[0] - expected).abs() < 1e-13);
//! ```

use super::states::{StateQuery, States};
use super::{Likelihood, NodeOfGroup, Scene};
use crate::math::gaussian::{Factor, LN_2_PI, propagate, root, triangularise};
use crate::model::endpoint::Endpoint;
use nalgebra::{DMatrix, DVector};

/// The exact likelihoods, (12); they keep nothing beyond the filter.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct SingleFilter;

/// The approximate likelihoods, (15); they keep nothing beyond the filter.
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
            for &i in node.members {
                let i = i as usize;
                let error = scene.endpoint_error(i, &endpoint, &scene.filter.mean(i));
                table[scene.plan.rows[i] + node.index] = scene.filter.evidence(i) + density.log_density(error);
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
            let s = scene.filter.states;
            let now = Endpoint::after(scene.motion, node.remaining, node.covariance.nrows());
            // q(x_1, z), (14)
            let mut both = DMatrix::zeros(s + now.matrix.nrows(), 2 * s);
            both.view_mut((0, 0), (s, s)).fill_with_identity();
            both.view_mut((s, s), now.matrix.shape()).copy_from(&now.matrix);
            let joint = joint_root(&both, scene, &now.noise);
            let Some(integral) = Integral::new(scene, &node, joint) else { continue };
            for &i in node.members {
                let i = i as usize;
                // a - c, z having the mean c
                let endpoint = scene.endpoint_error(i, &now, &scene.filter.mean(i));
                table[scene.plan.rows[i] + node.index] = scene.filter.evidence(i) + integral.log(scene, i, &endpoint);
            }
        }
    }

    /// The integrand of (12), normalised, is the density of `x_1`, `z` and the state at any time before the arrival.
    fn states(&self, query: &StateQuery<'_>) -> Option<States> {
        let scene = query.evidence;
        let (s, length) = (scene.filter.states, query.node.covariance.nrows());
        let (onward, left) = query.onward(&scene);
        let step = scene.motion.transition(onward);
        let rest = Endpoint::after(scene.motion, left, length);
        // q(x_1, x(t), z): x(t) from x_k and the step's noise, z from x(t) and the noise of the rest
        let mut all = DMatrix::zeros(2 * s + length, 2 * s);
        all.view_mut((0, 0), (s, s)).fill_with_identity();
        all.view_mut((s, s), (s, s)).copy_from(&step.transition);
        all.view_mut((2 * s, s), (length, s)).copy_from(&(&rest.matrix * &step.transition));
        let mut spread = DMatrix::zeros(s + length, s + length);
        let mut passed_on = DMatrix::identity(s + length, s);
        passed_on.rows_mut(s, length).copy_from(&rest.matrix);
        spread.view_mut((s, s), (length, length)).copy_from(&rest.noise);
        let noise = propagate(&passed_on, &step.noise, &spread);
        let integral = Integral::new(&scene, query.node, joint_root(&all, &scene, &noise))?;
        let at = integral.root.rows(s, s).into_owned();
        let mean = |&i: &usize| {
            let predicted = step.predict(&scene.filter.mean(i), scene.destinations.center(i));
            let endpoint = scene.endpoint_error(i, &rest, &predicted);
            predicted + &at * integral.mean(&scene, i, &endpoint)
        };
        let means = query.members.iter().map(mean).collect();
        Some(States { means, covariance: &at * integral.precision.solve(&at.transpose()) })
    }

    fn boxed(&self) -> Box<dyn Likelihood> {
        Box::new(*self)
    }
}

/// A root of the covariance of `rows [x_1; x_k] + e`, `e` being noise of the last rows, by the filter and smoother.
fn joint_root(rows: &DMatrix<f64>, scene: &Scene<'_>, noise: &DMatrix<f64>) -> DMatrix<f64> {
    let (n, l) = (rows.nrows(), noise.nrows());
    let known = rows * &scene.filter.root;
    let mut array = DMatrix::zeros(n, known.ncols() + l);
    array.columns_mut(0, known.ncols()).copy_from(&known);
    array.view_mut((n - l, known.ncols()), (l, l)).copy_from(&root(noise));
    triangularise(array)
}

/// The integrand of (12) for one node and one kind of endpoint, a Gaussian in `xi`: the joint of `x_1`, `z` and whatever lies
/// between them is `m + L xi` under `q`.
struct Integral {
    /// `L`, square: first the rows of `x_1`, last those of `z`.
    root: DMatrix<f64>,
    /// The rows of `z`.
    endpoint_root: DMatrix<f64>,
    /// `z - f's prediction = r + gap xi`.
    gap: DMatrix<f64>,
    /// The state at the first observation, that far before the arrival: `f(z | x_1)`.
    start: Endpoint,
    endpoint: Factor,
    denominator: Factor,
    precision: Factor,
    log_constant: f64,
}

impl Integral {
    /// None where the integral does not exist.
    fn new(scene: &Scene<'_>, node: &NodeOfGroup<'_>, root: DMatrix<f64>) -> Option<Self> {
        let (n, s, l) = (root.nrows(), scene.filter.states, node.covariance.nrows());
        let start = Endpoint::after(scene.motion, node.since_first, l);
        let endpoint_root = root.rows(n - l, l).into_owned();
        let gap = &endpoint_root - &start.matrix * root.rows(0, s);
        let endpoint = Factor::new(node.covariance.clone())?;
        let denominator = Factor::new(start.noise.clone())?;
        let mut precision = endpoint_root.transpose() * endpoint.solve(&endpoint_root);
        precision -= gap.transpose() * denominator.solve(&gap);
        for i in 0..n {
            precision[(i, i)] += 1.0;
        }
        crate::math::gaussian::symmetrise(&mut precision);
        let precision = Factor::new(precision)?;
        // the precision's log normaliser counts n ln(2 pi) / 2 that the integral over xi does not
        let log_constant = endpoint.log_normaliser() - denominator.log_normaliser() + precision_log(&precision, n);
        Some(Self { root, endpoint_root, gap, start, endpoint, denominator, precision, log_constant })
    }

    /// For destination `i` the exponent's linear term, and its constant term. `error` is `a - c`, `c` the mean of `z` under `q`.
    fn exponent(&self, scene: &Scene<'_>, i: usize, error: &DVector<f64>) -> (DMatrix<f64>, f64) {
        let column = |v: &DVector<f64>| DMatrix::from_column_slice(v.len(), 1, v.as_slice());
        // c less the denominator's prediction of z from the smoothed start
        let apart = scene.endpoint_error(i, &self.start, &scene.filter.start_mean(i)) - error;
        let (b, r) = (column(error), column(&apart));
        let (solved_b, solved_r) = (self.endpoint.solve(&b), self.denominator.solve(&r));
        let linear = self.endpoint_root.transpose() * &solved_b + &self.gap.transpose() * &solved_r;
        (linear, r.dot(&solved_r) - b.dot(&solved_b))
    }

    /// The logarithm of the integral over `q(y_2:k | y_1)`.
    fn log(&self, scene: &Scene<'_>, i: usize, error: &DVector<f64>) -> f64 {
        let (linear, constant) = self.exponent(scene, i, error);
        self.log_constant + 0.5 * (linear.dot(&self.precision.solve(&linear)) + constant)
    }

    /// The mean of `xi` under the normalised integrand.
    fn mean(&self, scene: &Scene<'_>, i: usize, error: &DVector<f64>) -> DVector<f64> {
        let (linear, _) = self.exponent(scene, i, error);
        self.precision.solve(&linear).column(0).into_owned()
    }
}

/// `-ln sqrt(det precision)`.
fn precision_log(precision: &Factor, n: usize) -> f64 {
    precision.log_normaliser() + 0.5 * n as f64 * LN_2_PI
}
