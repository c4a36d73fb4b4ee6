//! The transition towards a known end: Ardeshiri (6), Rezaie and Li (7)-(9).
//!
//! A Markov model moves as `x_k = F_h x_{k-1} + M_h + e`, `e ~ N(0, Q_h)`, over the step `h`, and as `F_R`, `M_R`, `Q_R`
//! over the rest of the way, `R = T - t_k`. Given `G~ x_T`, the first `l` components of the state at the end, it moves as
//! ```text
//! B = G~ F_R    S = B Q_h B' + G~ Q_R G~'    K = Q_h B' S^-1
//! x_k = (I - K B) F_h x_{k-1} + K G~ x_T + (I - K B) M_h - K G~ M_R + N(0, Q_h - K S K')
//! ```
//! which is the noise `e` conditioned on the observation `B e` with noise `G~ Q_R G~'`. With `l = s` it is Rezaie and Li's
//! (7)-(9) without their inverse of `C_{N|k} = Q_R`, so it stays exact as `R` goes to 0. Both `bridging` and the
//! conditionally Markov sequences move by it.

use crate::math::gaussian::condition;
use nalgebra::{DMatrix, DVector};

/// `x_k = previous x_{k-1} + destination (G~ x_T) + offset + e`, `e ~ N(0, covariance)`.
#[derive(Clone, Debug)]
pub struct Bridge {
    /// `A = (I - K B) F_h`, `s` by `s`; Rezaie and Li's `G_{k,k-1}` (7).
    pub previous: DMatrix<f64>,
    /// `K`, `s` by `l`; Rezaie and Li's `G_{k,N}` (8).
    pub destination: DMatrix<f64>,
    /// The covariance of the noise, `s` by `s`; Rezaie and Li's `G_k` (9). Semi-definite where the endpoint determines it.
    pub covariance: DMatrix<f64>,
    /// `I - K B`, the share of the Markov model's own step.
    kept: DMatrix<f64>,
}

impl Bridge {
    /// The transition over a step given by `F_h` (`s` by `s`) and `Q_h`, the rest of the way by `F_R` and `Q_R`, towards
    /// the first `components` of the state at the end; none where they are determined already, `S` being singular.
    ///
    /// It depends on no offset, so where the offset alone depends on the destination, one serves all destinations.
    #[must_use]
    pub fn new(
        step_transition: &DMatrix<f64>,
        step_noise: &DMatrix<f64>,
        rest_transition: &DMatrix<f64>,
        rest_noise: &DMatrix<f64>,
        components: usize,
    ) -> Option<Self> {
        let states = step_noise.nrows();
        let observed = rest_transition.rows(0, components).into_owned();
        let unobserved = rest_noise.view((0, 0), (components, components)).into_owned();
        let mut kept = DMatrix::identity(states, states);
        if step_noise.iter().all(|&x| x == 0.0) {
            // no time passes: the end has nothing to bend
            return Some(Self {
                previous: step_transition.clone(),
                destination: DMatrix::zeros(states, components),
                covariance: step_noise.clone(),
                kept,
            });
        }
        let conditioned = condition(step_noise, &observed, &unobserved)?;
        kept -= &conditioned.gain * &observed;
        Some(Self {
            previous: &kept * step_transition,
            covariance: conditioned.covariance(),
            destination: conditioned.gain,
            kept,
        })
    }

    /// The offset `(I - K B) M_h - K G~ M_R` for the Markov model's offsets over the step and over the rest of the way.
    #[must_use]
    pub fn offset(&self, step_offset: &DVector<f64>, rest_offset: &DVector<f64>) -> DVector<f64> {
        let components = self.destination.ncols();
        &self.kept * step_offset - &self.destination * rest_offset.rows(0, components)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use nalgebra::{dmatrix, dvector};

    /// Constant velocity on one axis with noise 1 and a constant acceleration of 0.5: `F`, `M`, `Q`.
    fn accelerated(h: f64) -> (DMatrix<f64>, DVector<f64>, DMatrix<f64>) {
        (
            dmatrix![1.0, h; 0.0, 1.0],
            dvector![0.25 * h * h, 0.5 * h],
            dmatrix![h * h * h / 3.0, h * h / 2.0; h * h / 2.0, h],
        )
    }

    fn bridge(h: f64, rest: f64, components: usize) -> (Bridge, DVector<f64>) {
        let (f_h, m_h, q_h) = accelerated(h);
        let (f_r, m_r, q_r) = accelerated(rest);
        let bridge = Bridge::new(&f_h, &q_h, &f_r, &q_r, components).unwrap();
        let offset = bridge.offset(&m_h, &m_r);
        (bridge, offset)
    }

    #[test]
    fn a_brownian_bridge_goes_its_share_of_the_way() {
        // a step of 1, 3 more to go
        let one = dmatrix![1.0];
        let bridge = Bridge::new(&one, &one, &one, &dmatrix![3.0], 1).unwrap();
        for (found, expected) in [(&bridge.previous, 0.75), (&bridge.destination, 0.25), (&bridge.covariance, 0.75)] {
            assert!((found[0] - expected).abs() < 1e-15);
        }
        // a drift of 2 a second changes nothing once the end is known
        assert!(bridge.offset(&dvector![2.0], &dvector![6.0])[0].abs() < 1e-14);
    }

    #[test]
    fn two_steps_are_one_step_of_both() {
        for components in [1, 2] {
            let (first, first_offset) = bridge(0.7, 2.3, components);
            let (second, second_offset) = bridge(0.3, 2.0, components);
            let (both, both_offset) = bridge(1.0, 2.0, components);
            let previous = &second.previous * &first.previous;
            let destination = &second.previous * &first.destination + &second.destination;
            let covariance = &second.previous * &first.covariance * second.previous.transpose() + &second.covariance;
            assert!((previous - both.previous).amax() < 1e-14);
            assert!((destination - both.destination).amax() < 1e-14);
            assert!((covariance - both.covariance).amax() < 1e-14);
            assert!((&second.previous * first_offset + second_offset - both_offset).amax() < 1e-14);
        }
    }

    #[test]
    fn a_whole_end_is_reached_exactly() {
        let (last, offset) = bridge(0.4, 0.0, 2);
        assert!(last.previous.amax() < 1e-12);
        assert!((last.destination - DMatrix::identity(2, 2)).amax() < 1e-12);
        assert!(last.covariance.amax() < 1e-12 && offset.amax() < 1e-12);
    }

    #[test]
    fn the_end_that_the_model_expects_changes_no_mean() {
        // integrating the model from x over h + R gives an end at which the bridged mean is the model's own
        let start = dvector![2.0, -1.0];
        let (f, m, _) = accelerated(3.0);
        let end = f * &start + m;
        let (bridge, offset) = bridge(0.5, 2.5, 1);
        let mean = bridge.previous * &start + bridge.destination * end.rows(0, 1) + offset;
        let (f, m, _) = accelerated(0.5);
        assert!((mean - (f * start + m)).amax() < 1e-14);
    }

    #[test]
    fn it_stays_exact_as_the_rest_of_the_way_vanishes() {
        let limit = bridge(1.0, 0.0, 1).0;
        for rest in [1e-3, 1e-6, 1e-9, 1e-12] {
            let near = bridge(1.0, rest, 1).0;
            assert!((near.covariance - &limit.covariance).amax() < 2.0 * rest);
            assert!((near.destination - &limit.destination).amax() < 3.0 * rest);
        }
    }

    #[test]
    fn where_no_time_passes_nothing_moves() {
        for rest in [0.0, 1.0] {
            let (still, offset) = bridge(0.0, rest, 2);
            assert_eq!(still.previous, DMatrix::identity(2, 2));
            assert!(still.destination.amax() == 0.0 && still.covariance.amax() == 0.0 && offset.amax() == 0.0);
        }
    }

    #[test]
    fn an_end_that_is_determined_already_is_refused() {
        let still = DMatrix::zeros(2, 2);
        let one_axis = dmatrix![1.0, 0.0; 0.0, 0.0];
        assert!(Bridge::new(&DMatrix::identity(2, 2), &one_axis, &DMatrix::identity(2, 2), &still, 2).is_none());
    }
}
