//! The filter of the pointing model: constant velocity whose noise grows with the speed, each axis a root of a
//! 4 by 4 covariance, that of the first state and the state now.
//!
//! An observation at the time of the last one replaces it: clocks that are rounded, and events stamped by the frame, give several
//! places one time, and of those the last is where the pointer was then. So the course keeps how it stood before the last one.

use super::parameters::Parameters;
use super::{Vector, dot, minus, vector};
use crate::error::Result;
use crate::math::small_root::{condition, triangularise};
use crate::value::{Node, Value};

/// The shortest step that the filter takes, in seconds: nearly equal times must not make the velocity certain.
const SHORTEST_STEP: f64 = 1e-4;

/// One axis of the state: position and velocity now, and at the start given all observations, with what ties them.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Axis {
    /// Position now.
    pub position: f64,
    /// Velocity now.
    pub velocity: f64,
    /// Variance of the position, covariance with the velocity, variance of the velocity.
    pub covariance: [f64; 3],
    /// Position and velocity at the first observation, smoothed.
    pub first: [f64; 2],
    /// A root of the covariance of both, lower triangular: the first state's rows, then those of the state now.
    root: [[f64; 4]; 4],
}

impl Axis {
    fn begin(position: f64, variance: f64, speed_variance: f64) -> Self {
        let (deviation, speed) = (variance.sqrt(), speed_variance.sqrt());
        let mut root = [[0.0; 4]; 4];
        for (row, column, entry) in [(0, 0, deviation), (1, 1, speed), (2, 0, deviation), (3, 1, speed)] {
            root[row][column] = entry;
        }
        Self::of(root, [position, 0.0], [position, 0.0])
    }

    fn of(root: [[f64; 4]; 4], first: [f64; 2], [position, velocity]: [f64; 2]) -> Self {
        let mut axis = Self { position, velocity, covariance: [0.0; 3], first, root };
        axis.square();
        axis
    }

    /// A root of the covariance of position and velocity at the first observation and now, lower triangular.
    #[must_use]
    pub const fn root(&self) -> &[[f64; 4]; 4] {
        &self.root
    }

    /// The covariance of the state now, from the root.
    fn square(&mut self) {
        let [_, _, p, v] = &self.root;
        self.covariance = [
            p[0] * p[0] + p[1] * p[1] + p[2] * p[2],
            p[0] * v[0] + p[1] * v[1] + p[2] * v[2],
            v[0] * v[0] + v[1] * v[1] + v[2] * v[2] + v[3] * v[3],
        ];
    }

    fn predict_root(&mut self, step: f64, noise: f64) {
        let velocity = self.root[3];
        for q in 0..4 {
            self.root[2][q] += step * velocity[q];
        }
        // beside what the state now has of its own, a root of the noise: the integral of white noise over the step
        let scale = (noise * step).sqrt();
        let third = step / 3f64.sqrt();
        let mut own = [
            [self.root[2][2], self.root[2][3], scale * third, 0.0],
            [velocity[2], velocity[3], scale * 0.75f64.sqrt(), scale * 0.5],
        ];
        triangularise(&mut own, 2, 4);
        for (i, own) in own.iter().enumerate() {
            (self.root[2 + i][2], self.root[2 + i][3]) = (own[0], own[1]);
        }
    }

    fn correct_mean(&mut self, gain: &[f64; 4], observed: f64) {
        let error = observed - self.position;
        self.first[0] += gain[0] * error;
        self.first[1] += gain[1] * error;
        self.position += gain[2] * error;
        self.velocity += gain[3] * error;
    }
}

/// One observation; none marks an axis that is missing.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Observed {
    position: [Option<f64>; 3],
    variances: Vector,
}

impl Observed {
    fn new(position: &[Option<f64>], variances: &[f64]) -> Self {
        let axis = |k: usize| position.get(k).copied().flatten();
        Self { position: std::array::from_fn(axis), variances: vector(variances) }
    }

    /// Itself, and where it is missing an axis, what `other` has of it.
    fn or(mut self, other: &Self) -> Self {
        for k in 0..3 {
            if self.position[k].is_none() {
                (self.position[k], self.variances[k]) = (other.position[k], other.variances[k]);
            }
        }
        self
    }
}

/// How a movement stood before its last observation.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Before {
    elapsed: f64,
    farthest: f64,
    axes: [Axis; 3],
    twins: [bool; 3],
}

/// How far a movement has begun: a pointer that rests where it was first observed has not, and what the start says of the
/// destinations fades.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Onset {
    /// How far the pointer has fallen short of the way that it should have come from its start by now.
    pub shortfall: f64,
    /// The share of that way that it has come, at most one.
    pub share: f64,
}

impl Onset {
    /// Of a movement that has begun.
    pub const BEGUN: Self = Self { shortfall: 0.0, share: 1.0 };
}

/// The movement so far, without regard to the destinations.
#[derive(Clone, Debug, PartialEq)]
pub struct Course {
    dimensions: usize,
    /// The first observed position `y_1`.
    pub start: Vector,
    /// `t_k - t_1`.
    pub elapsed: f64,
    /// The square of how far it has been from its start.
    farthest: f64,
    /// How many observations there were, those that were replaced not counted.
    pub observations: u64,
    /// The axes; those beyond the dimensions stay at zero.
    pub axes: [Axis; 3],
    /// Whether an axis has the root of the first one: it has begun and been observed alike.
    twins: [bool; 3],
    /// The last observation.
    last: Observed,
    /// Says nothing at the first observation.
    before: Before,
}

impl Course {
    /// Begins at the first observation, of variance `variances` in each axis.
    #[must_use]
    pub fn begin(parameters: &Parameters, position: &[f64], variances: &[f64]) -> Self {
        let mut start = Vector::default();
        let mut axes = [Axis::begin(0.0, 0.0, 0.0); 3];
        for (j, (&y, &variance)) in position.iter().zip(variances).enumerate().take(3) {
            start[j] = y;
            axes[j] = Axis::begin(y, variance, parameters.first_speed[j].powi(2));
        }
        let twins = axes.map(|axis| axis.root == axes[0].root);
        let last = Observed { position: vector(position).map(Some), variances: vector(variances) };
        Self {
            dimensions: position.len().min(3),
            start,
            elapsed: 0.0,
            farthest: 0.0,
            observations: 1,
            axes,
            twins,
            last,
            before: Before { elapsed: 0.0, farthest: 0.0, axes, twins },
        }
    }

    /// Takes in one more observation, `elapsed` seconds after the first one; none marks an axis that was not observed. At the time
    /// of the last one it replaces that, in the axes that it has, and at the first time the movement begins with it.
    pub fn advance(&mut self, parameters: &Parameters, elapsed: f64, position: &[Option<f64>], variances: &[f64]) {
        let (observed, d) = (Observed::new(position, variances), self.dimensions);
        if elapsed == self.elapsed {
            self.last = observed.or(&self.last);
            if self.observations < 2 {
                let position = self.last.position.map(|axis| axis.unwrap_or(0.0));
                *self = Self::begin(parameters, &position[..d], &self.last.variances);
                return;
            }
            Before { elapsed: self.elapsed, farthest: self.farthest, axes: self.axes, twins: self.twins } = self.before;
            self.observations -= 1;
        } else {
            self.last = observed;
            self.before.axes[..d].copy_from_slice(&self.axes[..d]);
            (self.before.elapsed, self.before.farthest, self.before.twins) = (self.elapsed, self.farthest, self.twins);
        }
        self.follow(parameters, elapsed);
    }

    /// Takes in `last`.
    fn follow(&mut self, parameters: &Parameters, elapsed: f64) {
        let Observed { position, variances } = self.last;
        let step = elapsed - self.elapsed;
        let velocity = self.velocity();
        let noise = parameters.filter_noise.powi(2) + parameters.speed_noise.powi(2) * dot(&velocity, &velocity);
        let (step, mut leading) = (step.max(SHORTEST_STEP), None);
        for (k, (observed, variance)) in position.into_iter().zip(variances).enumerate().take(self.dimensions) {
            let [Axis { root, covariance, .. }, ..] = self.axes;
            let axis = &mut self.axes[k];
            axis.position += step * axis.velocity;
            let twin = k > 0 && self.twins[k] && observed.is_some() == leading.is_some() && variance == variances[0];
            let gain = if twin {
                (axis.root, axis.covariance) = (root, covariance);
                leading
            } else {
                self.twins[k] = k == 0;
                axis.predict_root(step, noise);
                let gain = observed.map(|_| condition(&mut axis.root, 4, 2, variance).0);
                axis.square();
                gain
            };
            if let (Some(gain), Some(observed)) = (&gain, observed) {
                axis.correct_mean(gain, observed);
            }
            if k == 0 {
                leading = gain;
            }
        }
        let way = minus(&self.position(), &self.start);
        self.farthest = self.farthest.max(dot(&way, &way));
        self.elapsed = elapsed;
        self.observations += 1;
    }

    /// How far the movement has begun: by the time `t` it should have been `restDistance (1 - power.time/t)^2` from its start, and
    /// nothing before `power.time`, since until then no rest differs from a slow beginning.
    #[must_use]
    pub fn onset(&self, parameters: &Parameters) -> Onset {
        let expected = parameters.rest_distance * (1.0 - parameters.power.time / self.elapsed).max(0.0).powi(2);
        let way = self.farthest.sqrt();
        if way >= expected { Onset::BEGUN } else { Onset { shortfall: expected - way, share: way / expected } }
    }

    /// Spatial dimensions.
    #[must_use]
    pub const fn dimensions(&self) -> usize {
        self.dimensions
    }

    /// The position now.
    #[must_use]
    pub fn position(&self) -> Vector {
        let [x, y, z] = &self.axes;
        [x.position, y.position, z.position]
    }

    /// The velocity now.
    #[must_use]
    pub fn velocity(&self) -> Vector {
        let [x, y, z] = &self.axes;
        [x.velocity, y.velocity, z.velocity]
    }

    /// The speed now.
    #[must_use]
    pub fn speed(&self) -> f64 {
        let velocity = self.velocity();
        dot(&velocity, &velocity).sqrt()
    }

    /// What a snapshot keeps.
    #[must_use]
    pub fn save(&self) -> Value {
        let d = self.dimensions;
        let mut numbers = self.start[..d].to_vec();
        numbers.extend(self.last.position[..d].iter().map(|axis| axis.unwrap_or(f64::NAN)));
        numbers.extend(&self.last.variances[..d]);
        numbers.extend([self.farthest, self.before.elapsed, self.before.farthest]);
        for axis in self.axes[..d].iter().chain(&self.before.axes[..d]) {
            numbers.extend([axis.position, axis.velocity]);
            numbers.extend(axis.first);
            numbers.extend(axis.root.as_flattened());
        }
        Value::map([
            ("elapsed", Value::exact(self.elapsed)),
            ("observations", Value::Number(self.observations as f64)),
            ("axes", Value::exact_numbers(&numbers)),
        ])
    }

    /// The course that [`Course::save`] wrote.
    ///
    /// # Errors
    /// Those of reading a value.
    pub fn load(node: &Node<'_>, dimensions: usize) -> Result<Self> {
        let (d, each) = (dimensions, 20 * dimensions);
        let fields = node.fields(&["elapsed", "observations", "axes"])?;
        let numbers = fields.required("axes")?.exact_numbers(3 * (d + 1) + 2 * each)?;
        let (axes, twins) = load_axes(&numbers[3 * (d + 1)..][..each]);
        let (axes_before, twins_before) = load_axes(&numbers[3 * (d + 1) + each..]);
        let [farthest, elapsed_before, farthest_before] = vector(&numbers[3 * d..]);
        let before =
            Before { elapsed: elapsed_before, farthest: farthest_before, axes: axes_before, twins: twins_before };
        let mut position = [None; 3];
        for (axis, &number) in position.iter_mut().zip(&numbers[d..2 * d]) {
            *axis = (!number.is_nan()).then_some(number);
        }
        Ok(Self {
            dimensions,
            start: vector(&numbers[..d]),
            elapsed: fields.required("elapsed")?.exact()?,
            observations: fields.positive("observations")? as u64,
            axes,
            twins,
            last: Observed { position, variances: vector(&numbers[2 * d..3 * d]) },
            before,
            farthest,
        })
    }
}

/// The axes, and which are twins of the first.
fn load_axes(numbers: &[f64]) -> ([Axis; 3], [bool; 3]) {
    let mut axes = [Axis::begin(0.0, 0.0, 0.0); 3];
    for (axis, n) in axes.iter_mut().zip(numbers.chunks_exact(20)) {
        let root = std::array::from_fn(|i| std::array::from_fn(|j| n[4 + 4 * i + j]));
        *axis = Axis::of(root, [n[2], n[3]], [n[0], n[1]]);
    }
    (axes, axes.map(|axis| axis.root == axes[0].root))
}
