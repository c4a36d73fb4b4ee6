//! The endpoint's position where axes mix, one Gaussian with correlations, for four arrival nodes at a time; and the terms of
//! [`crate::mixture`] from it. Matrices are flat, column by column.

use crate::mixture::{Ellipsoid, HALF_LOG2_E};
use crate::vectors::{Block, Lanes, WIDTH};

const ZERO: Block = [0.0; WIDTH];

/// A list of so many blocks; its code once, as it is long.
#[inline(never)]
fn resize(blocks: &mut Vec<Block>, length: usize) {
    blocks.resize(length, ZERO);
}

/// Steps to arrival nodes, `x_T = F x + M + e`, `e ~ N(0, Q)`.
#[derive(Clone, Debug, Default)]
pub struct Steps {
    states: usize,
    nodes: usize,
    /// For each four nodes row by row: of `M`, of `F` and of `Q`.
    blocks: Vec<Block>,
}

impl Steps {
    /// Removes all steps; those that follow are of so many components.
    pub fn clear(&mut self, states: usize) {
        (self.states, self.nodes) = (states, 0);
        self.blocks.clear();
    }

    /// Adds the step to one more node.
    #[inline(never)]
    pub fn push(&mut self, transition: &[f64], offset: &[f64], noise: &[f64]) {
        let (s, lane, columns) = (self.states, self.nodes % WIDTH, 2 * self.states + 1);
        if lane == 0 {
            let length = self.blocks.len() + s * columns;
            resize(&mut self.blocks, length);
        }
        let begin = self.blocks.len() - s * columns;
        for (k, x) in offset.iter().chain(transition).chain(noise).enumerate() {
            self.blocks[begin + k % s * columns + k / s][lane] = *x;
        }
        self.nodes += 1;
    }
}

/// What the destination asks of the state there: of the position a Gaussian, of what follows it a Gaussian about these means.
#[derive(Clone, Copy, Debug)]
pub struct Endpoint<'a> {
    /// How many axes the position has.
    pub dimensions: usize,
    /// The means of the components after the position.
    pub rest: &'a [f64],
    /// The covariance of all of them.
    pub covariance: &'a [f64],
}

/// The endpoint's position for four nodes, and the density of the rest.
#[derive(Clone, Debug, Default)]
struct Position {
    mean: Vec<Block>,
    /// The precision, a row for each component of the endpoint; what is beyond the position has been eliminated.
    precision: Vec<Block>,
    /// The precision's determinant is one over this.
    determinant: Block,
    /// The density of the rest is the root of this ...
    density: Block,
    /// ... times two to this, and a constant.
    exponent: Block,
    /// The covariance is positive definite where this is above zero.
    least: Block,
}

impl Position {
    /// Predicts the endpoint from a state, of which there are the mean and the columns of the covariance, `step` before it.
    #[inline(never)]
    fn predict(
        &mut self,
        from: &[f64],
        (steps, block): (&Steps, usize),
        endpoint: &Endpoint<'_>,
        row: &mut Vec<Block>,
    ) {
        let (s, length) = (steps.states, endpoint.dimensions + endpoint.rest.len());
        let columns = 2 * s + 1;
        let step = &steps.blocks[block * s * columns..];
        resize(row, s + 1);
        resize(&mut self.mean, length);
        resize(&mut self.precision, length * length);
        for i in 0..length {
            let numbers = &step[i * columns..(i + 1) * columns];
            for (product, column) in row.iter_mut().zip(from.chunks_exact(s)) {
                let mut sum = Lanes::splat(0.0);
                for (f, x) in numbers[1..].iter().zip(column) {
                    sum = sum + Lanes::load(f) * Lanes::splat(*x);
                }
                sum.store(product);
            }
            (Lanes::load(&numbers[0]) + Lanes::load(&row[0])).store(&mut self.mean[i]);
            for j in 0..i + 1 {
                let own = Lanes::splat(endpoint.covariance[i + j * length]);
                let mut sum = Lanes::load(&numbers[s + 1 + j]) + own;
                for (f, product) in step[j * columns + 1..].iter().zip(&row[1..]) {
                    sum = sum + Lanes::load(product) * Lanes::load(f);
                }
                sum.store(&mut self.precision[i * length + j]);
                sum.store(&mut self.precision[j * length + i]);
            }
        }
    }

    /// Conditions the position on the rest, the last component first, and inverts its covariance: Gauss and Jordan in place; a
    /// positive definite matrix needs no pivoting.
    #[inline(never)]
    fn eliminate(&mut self, endpoint: &Endpoint<'_>, row: &mut [Block]) {
        let (d, length) = (endpoint.dimensions, self.mean.len());
        let one = Lanes::splat(1.0);
        let (mut determinant, mut density, mut exponent, mut least) = (one, one, Lanes::splat(0.0), one);
        for r in (0..length).rev() {
            let row = &mut row[..r.max(d)];
            let pivot = Lanes::load(&self.precision[r * length + r]);
            let inverse = one / pivot;
            least = least.at_most(pivot.at_least(Lanes::splat(f64::NEG_INFINITY)));
            for (to, from) in row.iter_mut().zip(&self.precision[r * length..]) {
                (Lanes::load(from) * inverse).store(to);
            }
            if r < d {
                determinant = determinant * pivot;
                inverse.store(&mut row[r]);
            } else {
                let error = Lanes::splat(endpoint.rest[r - d]) - Lanes::load(&self.mean[r]);
                density = density * inverse;
                exponent = exponent - Lanes::splat(HALF_LOG2_E) * (error * error * inverse);
                for (mean, gain) in self.mean.iter_mut().zip(&*row) {
                    (Lanes::load(mean) + Lanes::load(gain) * error).store(mean);
                }
            }
            for (i, other) in self.precision.chunks_exact_mut(length).enumerate().take(row.len()) {
                if i == r {
                    other[..d].copy_from_slice(row);
                    continue;
                }
                let factor = Lanes::load(&other[r]);
                if r < d {
                    other[r] = ZERO;
                }
                for (x, y) in other.iter_mut().zip(&*row) {
                    (Lanes::load(x) - factor * Lanes::load(y)).store(x);
                }
            }
        }
        determinant.store(&mut self.determinant);
        density.store(&mut self.density);
        exponent.store(&mut self.exponent);
        least.store(&mut self.least);
    }
}

/// Room for what four nodes are computed with, kept from step to step.
#[derive(Clone, Debug, Default)]
pub struct Room {
    here: Position,
    there: Position,
    row: Vec<Block>,
}

/// The endpoint predicted from now and from the start.
#[derive(Clone, Copy, Debug)]
pub struct Prediction<'a> {
    /// The state now, its mean and the columns of its covariance, and the steps from there.
    pub now: (&'a [f64], &'a Steps),
    /// The same from the start.
    pub start: (&'a [f64], &'a Steps),
    /// Prior probabilities of the nodes; zero for those that have passed.
    pub weights: &'a [Block],
    /// What all of them are multiplied with.
    pub weight: f64,
    /// What is added to every exponent.
    pub lead: f64,
}

impl Prediction<'_> {
    /// Adds the term of each node that has weight: the ratio of the endpoint's density given all observations to that given the
    /// first, about its mean given all. A node whose covariances are not positive definite has none.
    #[inline(never)]
    pub fn ellipsoids(&self, endpoint: &Endpoint<'_>, room: &mut Room, into: &mut Vec<Ellipsoid>) {
        let (d, length) = (endpoint.dimensions, endpoint.dimensions + endpoint.rest.len());
        let Room { here, there, row } = room;
        for (block, weights) in self.weights.iter().enumerate() {
            for (position, (state, steps)) in [(&mut *here, self.now), (&mut *there, self.start)] {
                position.predict(state, (steps, block), endpoint, row);
                position.eliminate(endpoint, row);
            }
            for lane in 0..WIDTH {
                if !(weights[lane] > 0.0 && here.least[lane] > 0.0 && there.least[lane] > 0.0) {
                    continue;
                }
                let determinants = there.determinant[lane] / here.determinant[lane];
                let square = determinants * (here.density[lane] / there.density[lane]);
                let mut term = Ellipsoid {
                    factor: self.weight * weights[lane] * square.sqrt(),
                    constant: self.lead + here.exponent[lane] - there.exponent[lane],
                    ..Ellipsoid::default()
                };
                for i in 0..d {
                    let apart = |j: usize| here.mean[j][lane] - there.mean[j][lane];
                    let mut lean = 0.0;
                    for j in 0..d {
                        let (after, before) = (here.precision[i * length + j], there.precision[i * length + j]);
                        lean += HALF_LOG2_E * before[lane] * apart(j);
                        let twice = if i == j { 1.0 } else { 2.0 };
                        term.curvature[i][j] = twice * HALF_LOG2_E * (before[lane] - after[lane]);
                    }
                    term.center[i] = here.mean[i][lane];
                    term.slope[i] = 2.0 * lean;
                    term.constant += lean * apart(i);
                }
                into.push(term);
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use nalgebra::{DMatrix, DVector, dmatrix, dvector};

    /// `ln N(a; F m + M, F P F' + Q + S)` of the first components.
    fn log_density(from: &(DVector<f64>, DMatrix<f64>), step: &DMatrix<f64>, noise: f64, a: &DVector<f64>) -> f64 {
        let n = a.len();
        let covariance = step * &from.1 * step.transpose();
        let covariance = (covariance + DMatrix::from_diagonal_element(4, 4, noise)).view((0, 0), (n, n)).into_owned()
            + DMatrix::from_fn(n, n, |i, j| if i == j { 2.0 } else { 0.3 });
        let error = a - (step * &from.0).rows(0, n).add_scalar(0.25);
        let square = error.dot(&(covariance.clone().try_inverse().unwrap() * &error));
        -0.5 * (square + (covariance * std::f64::consts::TAU).determinant().ln())
    }

    #[test]
    fn a_term_is_the_ratio_of_the_densities_of_the_endpoint() {
        let spread = dmatrix![3.0, 0.5, 0.2, 0.1; 0.5, 2.0, 0.0, 0.4; 0.2, 0.0, 1.0, 0.3; 0.1, 0.4, 0.3, 1.5];
        let (now, start) =
            ((dvector![1.0, -2.0, 0.5, 0.3], spread.clone()), (dvector![0.0, 1.0, -0.5, 0.1], spread * 1.5));
        let flat =
            |(mean, covariance): &(DVector<f64>, DMatrix<f64>)| [mean.as_slice(), covariance.as_slice()].concat();
        let step = |k: f64| dmatrix![1.0, 0.1, k, 0.0; 0.0, 1.0, 0.0, k; 0.0, 0.0, 1.0, -k; 0.0, 0.0, k, 1.0];
        let mut steps = Steps::default();
        steps.clear(4);
        // the last node is in a block of its own, the second has no weight, the third is singular there
        for k in 0..5 {
            let noise = if k == 2 { -9.0 } else { f64::from(k) };
            let noise = DMatrix::from_diagonal_element(4, 4, noise);
            steps.push(step(0.2 * f64::from(k)).as_slice(), &[0.25; 4], noise.as_slice());
        }
        let weights = [[0.5, 0.0, 0.5, 0.25], [0.125, 0.0, 0.0, 0.0]];
        for rest in [&[][..], &[0.7], &[0.7, -0.4]] {
            let length = 2 + rest.len();
            let own: Vec<f64> = (0..length * length).map(|i| if i % (length + 1) == 0 { 2.0 } else { 0.3 }).collect();
            let endpoint = Endpoint { dimensions: 2, rest, covariance: &own };
            let (from, from_start) = (flat(&now), flat(&start));
            let prediction = Prediction {
                now: (&from, &steps),
                start: (&from_start, &steps),
                weights: &weights,
                weight: 0.8,
                lead: 1.0,
            };
            let mut terms = Vec::new();
            prediction.ellipsoids(&endpoint, &mut Room::default(), &mut terms);
            assert_eq!(terms.len(), 3, "{terms:?}");
            for (term, (k, weight)) in terms.iter().zip([(0.0, 0.5), (3.0, 0.25), (4.0, 0.125)]) {
                let position = [2.0, 0.5];
                let mut exponent = term.constant;
                for i in 0..2 {
                    let d = position[i] - term.center[i];
                    let curved: f64 = (i..2).map(|j| term.curvature[i][j] * (position[j] - term.center[j])).sum();
                    exponent += d * (term.slope[i] + curved);
                }
                let a = DVector::from_iterator(length, position.iter().chain(rest).copied());
                let step = step(0.2 * k);
                let expected = log_density(&now, &step, k, &a) - log_density(&start, &step, k, &a);
                let found = (term.factor / (0.8 * weight)).ln() + (exponent - 1.0) * std::f64::consts::LN_2;
                assert!((found - expected).abs() < 1e-13, "{found} {expected}");
            }
        }
    }
}
