//! The filter of the pointing model: constant velocity whose noise grows with the speed, axis by axis.
//!
//! An observation at the time of the last one replaces it: clocks that are rounded, and events stamped by the frame, give several
//! places one time, and of those the last is where the pointer was then. So the course keeps its state before the last one.

use super::parameters::PointingConstants;
use super::shake::{self, Shake};
use super::{Space, Vector, dot, minus, vector};
use crate::engine::Lasting;
use crate::error::Result;
use crate::value::{Node, Value};
use whither_kernel::constant_velocity::ConstantVelocity;
use whither_kernel::mixture::AXES;
use whither_kernel::pairs::Motion;
use whither_kernel::small_gaussian::axis_filter::{AxisFilter, AxisFilters};

/// The shortest step that the filter takes, in seconds: nearly equal times must not make the velocity certain.
const SHORTEST_STEP: f64 = 1e-4;

/// One axis: position and velocity at the first observation and now.
type Axis = AxisFilter<2, 4>;

/// All axes; those beyond the dimensions stay at zero.
type Axes = AxisFilters<2, 4>;

/// The axes of a movement, all of which move alike.
fn axes_of(dimensions: usize, filters: [Axis; AXES]) -> Axes {
    Axes::new(dimensions, filters, &[true; AXES])
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

/// The state of a movement before its last observation.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Before {
    elapsed: f64,
    farthest: f64,
    axes: Axes,
}

/// How far a movement has begun: a pointer that rests where it was first observed has not, and the evidence of the start about the
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

/// The state of a movement after one observation, as far as probabilities depend on it: which observation it was, `t_k - t_1`, the
/// square of how far it has been from its start, and of each axis position and velocity, their variances and covariance between them.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Moment(pub [f64; 3 + 5 * AXES]);

impl Moment {
    /// Which observation it was.
    #[must_use]
    pub const fn observations(&self) -> f64 {
        self.0[0]
    }

    /// `t_k - t_1`.
    #[must_use]
    pub const fn elapsed(&self) -> f64 {
        self.0[1]
    }

    /// The position along an axis.
    #[must_use]
    pub const fn position(&self, axis: usize) -> f64 {
        self.0[3 + 5 * axis]
    }
}

/// The movement so far, without regard to the destinations.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Course<S> {
    space: S,
    /// The first observed position `y_1`.
    pub start: Vector,
    /// `t_k - t_1`.
    pub elapsed: f64,
    /// The square of how far it has been from its start.
    farthest: f64,
    /// How many observations there were, those that were replaced not counted.
    pub observations: u64,
    /// The filters of the axes.
    pub axes: Axes,
    /// The last observation.
    last: Observed,
    /// Meaningless at the first observation.
    before: Before,
    /// The hand apart from its shake, where it is expected to shake.
    shake: Option<Box<Shake>>,
}

impl<S: Space> Course<S> {
    /// Begins at the first observation, of variance `variances` in each axis.
    #[must_use]
    pub fn begin(space: S, parameters: &PointingConstants, position: &[f64], variances: &[f64]) -> Self {
        let mut start = Vector::default();
        let mut axes = [Axis::begin(0.0, [0.0; 2]); AXES];
        for (j, (&y, &variance)) in position.iter().zip(variances).enumerate().take(3) {
            start[j] = y;
            axes[j] = Axis::begin(y, [variance.sqrt(), parameters.first_speed[j]]);
        }
        let axes = axes_of(space.dimensions(), axes);
        let shake = (parameters.shake > 0.0).then(|| Box::new(Shake::begin(parameters, &start, &vector(variances))));
        let last = Observed { position: vector(position).map(Some), variances: vector(variances) };
        let before = Before { elapsed: 0.0, farthest: 0.0, axes };
        let mut course = Self { space, start, elapsed: 0.0, farthest: 0.0, observations: 1, axes, last, before, shake };
        course.part();
        course
    }

    /// Where the hand is expected to shake, the axes are the hand's alone. The state at the first observation stays as it was then.
    fn part(&mut self) {
        let Some(shake) = &self.shake else { return };
        for k in 0..self.space.dimensions() {
            let (now, covariance) = shake.estimate(k);
            self.axes[k].replace_now(now, covariance);
        }
    }

    /// What outlasts the movement: the evidence on how much the hand shakes, where it is expected to.
    #[must_use]
    pub fn lasting(&self) -> Lasting {
        self.shake.as_ref().map_or(Lasting::default(), |shake| shake.evidence())
    }

    /// Begins with what outlasted an earlier movement.
    pub fn carry(&mut self, lasting: &Lasting) {
        if let Some(shake) = &mut self.shake {
            shake.carry(lasting);
        }
    }

    /// Takes in one more observation, `elapsed` seconds after the first one; none marks an axis that was not observed. At the time
    /// of the last one it replaces that, in the axes that it has, and at the first time the movement begins with it.
    pub fn advance(
        &mut self,
        parameters: &PointingConstants,
        elapsed: f64,
        position: &[Option<f64>],
        variances: &[f64],
    ) {
        let (observed, d) = (Observed::new(position, variances), self.dimensions());
        let again = elapsed == self.elapsed;
        if again {
            self.last = observed.or(&self.last);
            if self.observations < 2 {
                let position = self.last.position.map(|axis| axis.unwrap_or(0.0));
                let lasting = self.lasting();
                *self = Self::begin(self.space, parameters, &position[..d], &self.last.variances);
                self.carry(&lasting);
                return;
            }
            Before { elapsed: self.elapsed, farthest: self.farthest, axes: self.axes } = self.before;
            self.observations -= 1;
        } else {
            self.last = observed;
            (self.before.elapsed, self.before.farthest) = (self.elapsed, self.farthest);
            self.before.axes = self.axes;
        }
        self.follow(parameters, elapsed, again);
    }

    /// Takes in `last`, with `again` in the place of the one before.
    fn follow(&mut self, parameters: &PointingConstants, elapsed: f64, again: bool) {
        let Observed { position, variances } = self.last;
        let step = elapsed - self.elapsed;
        let velocity = self.velocity();
        let noise = parameters.filter_noise.powi(2) + parameters.speed_noise.powi(2) * dot(&velocity, &velocity);
        let seconds = step.max(SHORTEST_STEP);
        if let Some(shake) = &mut self.shake {
            shake.advance(parameters, seconds, (&position, &variances), again);
            self.part();
        } else {
            ConstantVelocity { seconds, noise }.advance(&mut self.axes, &position, &variances);
        }
        let way = minus(&self.position(), &self.start);
        self.farthest = self.farthest.max(dot(&way, &way));
        self.elapsed = elapsed;
        self.observations += 1;
    }

    /// How far the movement has begun: by the time `t` it should have been `restDistance (1 - power.time/t)^2` from its start, and
    /// nothing before `power.time`, since until then no rest differs from a slow beginning.
    #[must_use]
    pub fn onset(&self, parameters: &PointingConstants) -> Onset {
        let expected = parameters.rest_distance * (1.0 - parameters.power.time / self.elapsed).max(0.0).powi(2);
        let way = self.farthest.sqrt();
        if way >= expected { Onset::BEGUN } else { Onset { shortfall: expected - way, share: way / expected } }
    }

    /// The state now.
    #[must_use]
    pub fn moment(&self) -> Moment {
        let mut moment = Moment([0.0; 3 + 5 * AXES]);
        let (general, axes) = moment.0.split_at_mut(3);
        general.copy_from_slice(&[self.observations as f64, self.elapsed, self.farthest]);
        for (axis, into) in self.axes.iter().zip(axes.as_chunks_mut().0) {
            let ([x, v], [[pp, pv], [_, vv]]) = (axis.now, axis.covariance);
            *into = [x, v, pp, pv, vv];
        }
        moment
    }

    /// Goes back to a state, for what [`Moment`] is enough for.
    pub fn recall(&mut self, Moment(numbers): &Moment) {
        let (general, axes) = numbers.split_at(3);
        (self.observations, self.elapsed, self.farthest) = (general[0] as u64, general[1], general[2]);
        for (k, &[x, v, pp, pv, vv]) in axes.as_chunks().0.iter().enumerate() {
            (self.axes[k].now, self.axes[k].covariance) = ([x, v], [[pp, pv], [pv, vv]]);
        }
    }

    /// The space of the movement.
    #[must_use]
    pub fn space(&self) -> S {
        self.space
    }

    /// Spatial dimensions.
    #[must_use]
    pub fn dimensions(&self) -> usize {
        self.space.dimensions()
    }

    /// The position now.
    #[must_use]
    pub fn position(&self) -> Vector {
        // no array map: at the level for size each entry would be a call
        [self.axes[0].now[0], self.axes[1].now[0], self.axes[2].now[0]]
    }

    /// What the endpoint depends on.
    #[must_use]
    pub fn motion(&self) -> Motion {
        let variances = |axis: usize| {
            let [[pp, pv], [_, vv]] = self.axes[axis].covariance;
            [pp, pv + pv, vv]
        };
        Motion {
            position: self.position(),
            velocity: self.velocity(),
            variances: [variances(0), variances(1), variances(2)],
        }
    }

    /// The velocity now.
    #[must_use]
    pub fn velocity(&self) -> Vector {
        [self.axes[0].now[1], self.axes[1].now[1], self.axes[2].now[1]]
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
        let d = self.dimensions();
        let mut numbers = self.start[..d].to_vec();
        numbers.extend(self.last.position[..d].iter().map(|axis| axis.unwrap_or(f64::NAN)));
        numbers.extend(&self.last.variances[..d]);
        numbers.extend([self.farthest, self.before.elapsed, self.before.farthest]);
        for axis in self.axes.iter().chain(self.before.axes.iter()) {
            numbers.extend(axis.now);
            numbers.extend(axis.first);
            numbers.extend(axis.root().as_flattened());
        }
        numbers.extend(self.shake.iter().flat_map(|shake| shake.save()));
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
    pub fn load(node: &Node<'_>, space: S, parameters: &PointingConstants) -> Result<Self> {
        let (d, each) = (space.dimensions(), 20 * space.dimensions());
        let shaken = if parameters.shake > 0.0 { shake::NUMBERS } else { 0 };
        let fields = node.fields(&["elapsed", "observations", "axes", "trail"])?;
        let numbers = fields.required("axes")?.exact_numbers(3 * (d + 1) + 2 * each + shaken)?;
        let (numbers, shaken) = numbers.split_at(3 * (d + 1) + 2 * each);
        let axes = load_axes(d, &numbers[3 * (d + 1)..][..each]);
        let axes_before = load_axes(d, &numbers[3 * (d + 1) + each..]);
        let [farthest, elapsed_before, farthest_before] = vector(&numbers[3 * d..]);
        let before = Before { elapsed: elapsed_before, farthest: farthest_before, axes: axes_before };
        let mut position = [None; 3];
        for (axis, &number) in position.iter_mut().zip(&numbers[d..2 * d]) {
            *axis = (!number.is_nan()).then_some(number);
        }
        Ok(Self {
            space,
            start: vector(&numbers[..d]),
            elapsed: fields.required("elapsed")?.exact()?,
            observations: fields.positive("observations")? as u64,
            axes,
            last: Observed { position, variances: vector(&numbers[2 * d..3 * d]) },
            before,
            farthest,
            shake: (!shaken.is_empty()).then(|| Box::new(Shake::load(shaken))),
        })
    }
}

/// The axes that [`Course::save`] wrote.
fn load_axes(dimensions: usize, numbers: &[f64]) -> Axes {
    let mut axes = [Axis::begin(0.0, [0.0; 2]); AXES];
    for (axis, n) in axes.iter_mut().zip(numbers.chunks_exact(20)) {
        let root = std::array::from_fn(|i| std::array::from_fn(|j| n[4 + 4 * i + j]));
        *axis = Axis::new(2, [n[2], n[3]], [n[0], n[1]], root);
    }
    axes_of(dimensions, axes)
}
