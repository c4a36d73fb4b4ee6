//! The Gaussians of fixed size of `whither_kernel` against those of dynamic matrices.

use super::gaussian::{self, Gaussian};
use super::kalman::{Filter, Measurement, TimeUpdate};
use nalgebra::{DMatrix, dmatrix, dvector};
use whither_kernel::mixture::AXES;
use whither_kernel::small_gaussian::Matrix;
use whither_kernel::small_gaussian::axis_filter::{AxisFilter, AxisFilters, Step};

/// Constant velocity over one second, with the noise `L L'`.
struct Second;

const NOISE_ROOT: Matrix<2> = [[0.5, 0.0], [0.75, 0.25]];

impl Step<2, 4> for Second {
    fn states(&self) -> usize {
        2
    }

    fn mean(&self, x: &mut [f64; 2]) {
        x[0] += x[1];
    }

    fn root(&self, [position, velocity]: &mut [[f64; 4]; 2]) {
        position.iter_mut().zip(velocity).for_each(|(position, velocity)| *position += *velocity);
    }

    fn noise_root(&self) -> Matrix<2> {
        NOISE_ROOT
    }
}

/// The same with dynamic matrices, for one axis.
fn advance(filter: &mut Filter, observed: Option<f64>, variance: f64) {
    let noise = DMatrix::from_fn(2, 2, |i, j| NOISE_ROOT[i][j]);
    let (noise, zero) = (&noise * noise.transpose(), DMatrix::zeros(2, 1));
    filter.predict(&TimeUpdate { transition: &dmatrix![1.0, 1.0; 0.0, 1.0], offsets: &zero, noise: &noise });
    if let Some(y) = observed {
        let (value, matrix) = (dvector![y], dmatrix![1.0, 0.0]);
        assert!(filter.correct(&Measurement { value, matrix, noise: dmatrix![variance] }));
    }
}

#[test]
fn every_axis_is_a_filter_of_its_own_twin_or_not() {
    let root = [[2.0, 0.0, 0.0, 0.0], [0.0, 3.0, 0.0, 0.0], [2.0, 0.0, 0.0, 0.0], [0.0, 3.0, 0.0, 0.0]];
    let begin = |y: f64| AxisFilter::new(2, [y, 0.0], [y, 0.0], root);
    let mut axes = AxisFilters::new(3, [begin(0.0), begin(10.0), begin(-5.0)], &[true; AXES]);
    let covariance = dmatrix![4.0, 0.0; 0.0, 9.0];
    let mut dense =
        [0.0, 10.0, -5.0].map(|y| Filter::new(&Gaussian { mean: dvector![y, 0.0], covariance: covariance.clone() }, 1));
    // the third axis is missing once, then the second has another variance
    let observed = [
        ([Some(1.0), Some(12.0), Some(-4.0)], [0.5; 3], [true; 3]),
        ([Some(2.0), Some(13.0), None], [0.5; 3], [true, true, false]),
        ([Some(2.5), Some(13.0), Some(-2.0)], [0.5, 0.7, 0.5], [true, false, false]),
        ([None, None, Some(0.0)], [0.5; 3], [true, false, false]),
    ];
    for (position, variance, twins) in observed {
        let mut squares = 0.0;
        axes.advance(|_| Some(Second), &position, &variance, |error, variance| squares += error * error / variance);
        assert!(squares > 0.0);
        for (axis, filter) in dense.iter_mut().enumerate() {
            advance(filter, position[axis], variance[axis]);
            assert_eq!(axes.is_twin(axis), twins[axis]);
            let (found, expected, start) = (&axes[axis], filter.mean(0), filter.smoothed_start(0));
            for i in 0..2 {
                assert!((found.now[i] - expected[i]).abs() < 1e-13);
                assert!((found.first[i] - start.mean[i]).abs() < 1e-13);
                for j in 0..2 {
                    assert!((found.covariance[i][j] - filter.current_covariance()[(i, j)]).abs() < 1e-13);
                }
            }
        }
    }
}

fn dense<const S: usize>(a: &Matrix<S>) -> DMatrix<f64> {
    DMatrix::from_fn(S, S, |i, j| a[i][j])
}

#[test]
fn conditioning_is_that_of_dynamic_matrices() {
    let mut root = [[2.0, 0.0, 0.0], [0.5, 1.0, 0.0], [-0.3, 0.7, 0.4]];
    let expected = gaussian::condition_root(&dense(&root), &dmatrix![0.0, 1.0, 0.0], &dmatrix![0.3]).unwrap();
    let (gain, variance) = whither_kernel::small_gaussian::condition(&mut root, 3, 1, 0.3);
    assert!((dense(&root) - &expected.root).amax() < 1e-15);
    assert!((0..3).all(|i| (gain[i] - expected.gain[(i, 0)]).abs() < 1e-15));
    assert!((variance - expected.prediction_error.into_root()[(0, 0)].powi(2)).abs() < 1e-15);
}
