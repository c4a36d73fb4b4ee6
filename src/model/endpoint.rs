//! The endpoint seen from a state some time before it: `G~ x_T = B x + n + D c + e`, `e ~ N(0, G~ Q G~')`, Liang (9).

use super::motion::{MotionModel, Transition};
use nalgebra::{DMatrix, DVector};

/// The first `l` components of the state a time `R` later.
///
/// ```
/// use whither::{Value, model::{endpoint::Endpoint, motion::Motion}, value::Node};
/// let value: Value = serde_json::from_str(r#"{ "type": "constantVelocity", "dimensions": 1, "noise": 3 }"#).unwrap();
/// let motion = Motion::read(&Node::root(&value, "motion")).unwrap();
/// // the position, two seconds later
/// let endpoint = Endpoint::after(motion.candidates[0].model.as_ref(), 2.0, 1);
/// assert_eq!((endpoint.matrix[(0, 0)], endpoint.matrix[(0, 1)]), (1.0, 2.0));
/// assert_eq!(endpoint.noise[(0, 0)], 24.0); // 3^2 2^3 / 3
/// ```
#[derive(Clone, Debug)]
pub struct Endpoint {
    /// `B = G~ F(R)`, `l` by `s`.
    pub matrix: DMatrix<f64>,
    /// `n = G~ M(R)`.
    pub offset: DVector<f64>,
    /// `D`, `l` by `d`, where the motion model knows the destination.
    pub destination_gain: Option<DMatrix<f64>>,
    /// `G~ Q(R) G~'`, `l` by `l`.
    pub noise: DMatrix<f64>,
}

impl Endpoint {
    /// The endpoint of `length` components after `time` of `motion`.
    #[must_use]
    pub fn after(motion: &dyn MotionModel, time: f64, length: usize) -> Self {
        let step = motion.transition(time);
        Self {
            matrix: step.transition.rows(0, length).into_owned(),
            offset: step.offset.rows(0, length).into_owned(),
            destination_gain: step.destination_gain.map(|gain| gain.rows(0, length).into_owned()),
            noise: step.noise.view((0, 0), (length, length)).into_owned(),
        }
    }

    /// `n + D c`, the part of the prediction that does not depend on the state.
    #[must_use]
    pub fn constant(&self, center: &[f64]) -> DVector<f64> {
        constant(&self.offset, self.destination_gain.as_ref(), center)
    }

    /// `a - (B x + n + D c)`, the pseudo-observation's prediction error.
    #[must_use]
    pub fn error(&self, endpoint: &[f64], state: &DVector<f64>, center: &[f64]) -> DVector<f64> {
        DVector::from_column_slice(endpoint) - &self.matrix * state - self.constant(center)
    }
}

impl Transition {
    /// `M + B c`, the part of the step that does not depend on the state.
    #[must_use]
    pub fn constant(&self, center: &[f64]) -> DVector<f64> {
        constant(&self.offset, self.destination_gain.as_ref(), center)
    }
}

fn constant(offset: &DVector<f64>, gain: Option<&DMatrix<f64>>, center: &[f64]) -> DVector<f64> {
    match gain {
        Some(gain) => offset + gain * DVector::from_column_slice(center),
        None => offset.clone(),
    }
}
