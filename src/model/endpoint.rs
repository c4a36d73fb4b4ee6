//! The endpoint given a state some time before it: `G~ x_T = B x + n + D c + e`, `e ~ N(0, G~ Q G~')`, Liang (9).

use super::motion::{MotionModel, Transition};
use crate::math::gaussian::Factor;
use nalgebra::{DMatrix, DVector};

/// How near to no noise at all counts as none, in units of each component's own deviation.
const NO_NOISE: f64 = 1e-12;

/// The first `l` components of the state a time `R` later.
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

    /// Whether the state determines part of the endpoint: `G~ Q(R) G~'` is singular, whatever its units.
    #[must_use]
    pub fn is_singular(&self) -> bool {
        let deviation = |i: usize| self.noise[(i, i)].sqrt();
        let length = self.noise.nrows();
        let correlation = DMatrix::from_fn(length, length, |i, j| match (i == j, self.noise[(i, j)]) {
            (false, 0.0) => 0.0,
            (false, covariance) => covariance / deviation(i) / deviation(j),
            (true, variance) => f64::from(u8::from(variance > 0.0)) - NO_NOISE,
        });
        // what overflows is another matter
        self.noise.iter().all(|x| x.is_finite()) && Factor::new(correlation).is_none()
    }

    /// `n + D c`, the part of the prediction that does not depend on the state.
    #[must_use]
    pub fn constant(&self, center: &[f64]) -> DVector<f64> {
        constant(&self.offset, self.destination_gain.as_ref(), center)
    }

    /// `a - (B x + n + D c)`, the pseudo-observation's prediction error.
    #[must_use]
    pub fn error(&self, endpoint: Vec<f64>, state: &DVector<f64>, center: &[f64]) -> DVector<f64> {
        let mut error = DVector::from_vec(endpoint);
        error.gemv(-1.0, &self.matrix, state, 1.0);
        error -= &self.offset;
        if let Some(gain) = &self.destination_gain {
            error.gemv(-1.0, gain, &DVector::from_column_slice(center), 1.0);
        }
        error
    }
}

impl Transition {
    /// `M + B c`, the part of the step that does not depend on the state.
    #[must_use]
    pub fn constant(&self, center: &[f64]) -> DVector<f64> {
        constant(&self.offset, self.destination_gain.as_ref(), center)
    }

    /// `F x + M + B c`, Liang (1) without the noise.
    #[must_use]
    pub fn predict(&self, state: &DVector<f64>, center: &[f64]) -> DVector<f64> {
        let mut predicted = self.constant(center);
        predicted.gemv(1.0, &self.transition, state, 1.0);
        predicted
    }
}

fn constant(offset: &DVector<f64>, gain: Option<&DMatrix<f64>>, center: &[f64]) -> DVector<f64> {
    match gain {
        Some(gain) => offset + gain * &DVector::from_column_slice(center),
        None => offset.clone(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::model::motion::Motion;
    use crate::value::{Node, Value};

    fn endpoint(motion: &str, time: f64, length: usize) -> Endpoint {
        let value: Value = serde_json::from_str(motion).unwrap();
        let node = Node::root(&value, "motion");
        let motion = Motion::read(&node).unwrap().models(node.place()).unwrap();
        Endpoint::after(motion.candidates[0].model.as_ref(), time, length)
    }

    #[test]
    fn noise_is_singular_where_some_of_the_endpoint_has_none_whatever_the_units() {
        // from the velocity, in units of 1e-9, noise reaches both components of the axis that has any
        let one_axis = r#"{ "type": "custom", "dimensions": 2, "drift": [[0, 0, 1], [0, 0, 0], [0, 0, 0]],
                            "diffusion": [[0, 0, 0], [0, 0, 0], [0, 0, 1e-18]] }"#;
        assert!(!endpoint(one_axis, 1.0, 1).is_singular());
        assert!(endpoint(one_axis, 1.0, 2).is_singular());
        let together =
            r#"{ "type": "custom", "dimensions": 2, "drift": [[0, 0], [0, 0]], "diffusion": [[1e12, 3], [3, 9e-12]] }"#;
        assert!(endpoint(together, 1.0, 2).is_singular());
        let jerk = r#"{ "type": "custom", "dimensions": 1, "drift": [[0, 1, 0, 0], [0, 0, 1, 0], [0, 0, 0, 1], [0, 0, 0, 0]],
                        "diffusion": [[0, 0, 0, 0], [0, 0, 0, 0], [0, 0, 0, 0], [0, 0, 0, 1]] }"#;
        for (time, length) in [(1e-3, 4), (1.0, 4), (1e3, 4), (1.0, 1)] {
            assert!(!endpoint(jerk, time, length).is_singular());
        }
    }
}
