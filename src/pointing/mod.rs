//! The pointing model: where a hand or a pointer is going. Ours, beyond the papers.
//!
//! It keeps their structure, a filter and a closed-form density of the endpoint summed over the time to go, against what
//! the start alone says of the endpoint, and replaces what recorded hands contradict:
//!
//! | part | what it is for | where |
//! |---|---|---|
//! | filter | a hand that moves fast changes its velocity more than one that rests | `course` |
//! | endpoint density | where the movement would end if it went on, some time from now, wider along the way than across | `endpoint` |
//! | start density | what was already likely before the movement: near targets are many, far ones few | `evidence` |
//! | direction | the way covered so far points at the target, the better the farther one has come | `evidence` |
//! | power | the first samples say less than the model believes, the later ones more | [`parameters::Power`] |
//! | near | a movement seldom ends where it began | `evidence` |
//! | onset | a pointer that rests from the start on has not begun a movement, and may mean what it rests on | `course` |
//!
//! `targets` and `kernel` do it for all destinations at the speed of the machine; the other parts say it one destination at
//! a time, for the log likelihoods and whatever else is asked.
//!
//! Nothing is accumulated for a destination, so destinations may come, go and move at any time.

pub(crate) mod course;
pub(crate) mod endpoint;
pub mod entry_time;
pub(crate) mod evidence;
pub(crate) mod kernel;
pub mod parameters;
mod posterior;
mod state;
pub(crate) mod targets;

use crate::math::log_sum_exp::share;
use crate::model::destination::Destinations;
use course::{Course, Onset};
use endpoint::Nodes;
use evidence::{DirectionNow, log_near, log_start};
use kernel::{Now, Work};
use parameters::Parameters;
use std::sync::Arc;
use targets::Targets;

/// A position, velocity or offset; components beyond the dimensions are zero.
///
/// ```
/// use whither::pointing::{Vector, dot, vector};
/// let way: Vector = vector(&[3.0, 4.0]);
/// assert_eq!((way, dot(&way, &way)), ([3.0, 4.0, 0.0], 25.0));
/// ```
pub type Vector = [f64; 3];

/// A symmetric matrix: xx, xy, yy, xz, yz, zz.
pub(crate) type Symmetric<N = f64> = [N; 6];

/// The inner product.
#[must_use]
pub fn dot(a: &Vector, b: &Vector) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

/// The cross product: as long as both are, times the sine of the angle between them.
#[must_use]
pub fn cross(a: &Vector, b: &Vector) -> Vector {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

/// The difference.
#[must_use]
pub fn minus(a: &Vector, b: &Vector) -> Vector {
    [a[0] - b[0], a[1] - b[1], a[2] - b[2]]
}

/// The components of a position, the others zero.
#[must_use]
pub fn vector(components: &[f64]) -> Vector {
    let mut v = Vector::default();
    v.iter_mut().zip(components).for_each(|(to, from)| *to = *from);
    v
}

/// One movement under the pointing model.
#[derive(Clone, Debug)]
pub(crate) struct Pointing {
    parameters: Arc<Parameters>,
    /// That of the start density.
    log_volume: f64,
    course: Course,
    nodes: Nodes,
    targets: Targets,
    work: Work,
}

impl Pointing {
    /// Begins at the first observation, of variance `variances` in each axis.
    #[must_use]
    pub fn begin(
        parameters: Arc<Parameters>,
        destinations: &Destinations,
        position: &[f64],
        variances: &[f64],
    ) -> Self {
        let course = Course::begin(&parameters, position, variances);
        Self::resume(parameters, destinations, course)
    }

    /// Goes on from a course that was saved.
    #[must_use]
    pub fn resume(parameters: Arc<Parameters>, destinations: &Destinations, course: Course) -> Self {
        let (nodes, targets) = (Nodes::new(&parameters, &course), Targets::default());
        let log_volume = parameters.start.log_volume(course.dimensions());
        let mut pointing = Self { parameters, log_volume, course, nodes, targets, work: Work::default() };
        pointing.replan(destinations);
        pointing
    }

    /// Takes in one more observation, `elapsed` seconds after the first one; none marks an axis that was not observed. At the time
    /// of the last one it replaces that. `destinations` are those that the movement began with or was last given.
    pub fn advance(&mut self, destinations: &Destinations, elapsed: f64, position: &[Option<f64>], variances: &[f64]) {
        self.course.advance(&self.parameters, elapsed, position, variances);
        if self.course.observations < 2 {
            self.replan(destinations);
        }
        self.nodes.refresh(&self.parameters, &self.course);
    }

    fn onset(&self) -> Onset {
        self.course.onset(&self.parameters)
    }

    /// The movement so far.
    #[must_use]
    pub const fn course(&self) -> &Course {
        &self.course
    }

    /// Other destinations, in mid-movement too.
    pub fn replan(&mut self, destinations: &Destinations) {
        self.targets.fill(destinations, &self.parameters, self.log_volume, &self.course.start);
    }

    /// Writes the probabilities among the destinations, `prior_i near_i (N_i / S_i)^g e^B_i` over their sum, and returns the
    /// logarithm of that sum; none where nothing is known of any of them.
    pub fn probabilities(&mut self, destinations: &Destinations, into: &mut Vec<f64>) -> Option<f64> {
        let onset = self.onset();
        if self.course.observations > 1 {
            self.targets.begin(destinations, &self.parameters, self.log_volume, &self.course.start, onset);
            let now = Now {
                nodes: &self.nodes,
                direction: &DirectionNow::new(&self.parameters.direction, &self.course),
                start: &self.course.start,
                power: self.parameters.power.after(self.course.elapsed),
            };
            if let Some(log_sum) = self.work.probabilities(destinations, &self.targets, &now, into) {
                return Some(log_sum);
            }
        }
        self.log_likelihoods(destinations, into);
        let total: f64 = destinations.priors().iter().sum();
        for (i, (value, prior)) in into.iter_mut().zip(destinations.priors()).enumerate() {
            let offset = minus(&vector(&destinations.center(i)), &self.course.start);
            let near = log_near(self.parameters.near, &offset, destinations.kind(i), self.course.dimensions());
            *value += onset.share * near + (prior / total).ln();
        }
        share(into)
    }

    /// `g (ln N_i - ln S_i) + B_i` for every destination; zero after the first observation alone.
    pub fn log_likelihoods(&self, destinations: &Destinations, into: &mut Vec<f64>) {
        let parameters = &*self.parameters;
        into.clear();
        if self.course.observations < 2 {
            into.resize(destinations.len(), 0.0);
            return;
        }
        let power = parameters.power.after(self.course.elapsed);
        let direction = DirectionNow::new(&parameters.direction, &self.course);
        let (pairs, onset) = (self.nodes.pairs(), self.onset());
        into.extend((0..destinations.len()).map(|i| {
            let (center, kind) = (destinations.center(i), destinations.kind(i));
            let offset = minus(&vector(&center), &self.course.start);
            let start = log_start(&parameters.start, &offset, &onset) - self.log_volume;
            let seen = direction.log_evidence(&offset, kind);
            let whole = power * (pairs.log_density(&center, kind) - start) + seen;
            // beyond what numbers can tell, as far away and as fast as nothing on a screen, nothing is known
            if whole < f64::INFINITY { whole } else { f64::NEG_INFINITY }
        }));
    }

    /// What a destination has to gain to count as much against "none" as it did at the first observation.
    #[must_use]
    pub fn log_likelihood_of_none(&self) -> f64 {
        let power = &self.parameters.power;
        if self.course.observations < 2 {
            return 0.0;
        }
        self.parameters.none_offset + self.parameters.none_gain * (power.after(self.course.elapsed) - power.from)
    }

    /// The pairs of noise scale and time to go after the latest observation.
    #[must_use]
    pub const fn nodes(&self) -> &Nodes {
        &self.nodes
    }

    /// The constants.
    #[must_use]
    pub fn parameters(&self) -> &Parameters {
        &self.parameters
    }
}
