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
//!
//! Nothing is accumulated for a destination, so destinations may come, go and move at any time.

pub(crate) mod course;
pub(crate) mod endpoint;
pub mod entry_time;
pub(crate) mod evidence;
pub mod parameters;

use crate::model::destination::Destinations;
use course::Course;
use endpoint::Nodes;
use parameters::Parameters;
use std::sync::Arc;

/// A position, velocity or offset; components beyond the dimensions are zero.
///
/// ```
/// use whither::likelihood::pointing::{Vector, dot, vector};
/// let way: Vector = vector(&[3.0, 4.0]);
/// assert_eq!((way, dot(&way, &way)), ([3.0, 4.0, 0.0], 25.0));
/// ```
pub type Vector = [f64; 3];

/// A symmetric matrix: xx, xy, yy, xz, yz, zz.
pub(crate) type Symmetric = [f64; 6];

/// The inner product.
#[must_use]
pub fn dot(a: &Vector, b: &Vector) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
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
    course: Course,
    /// `ln S_i` and the logarithm of the factor `near`, for each destination.
    log_start: Vec<f64>,
    log_near: Vec<f64>,
    /// `ln N_i`, kept to save its memory.
    log_endpoint: Vec<f64>,
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
        let mut pointing =
            Self { parameters, course, log_start: Vec::new(), log_near: Vec::new(), log_endpoint: Vec::new() };
        pointing.replan(destinations);
        pointing
    }

    /// Takes in one more observation, `elapsed` seconds after the first one; none marks an axis that was not observed.
    pub fn advance(&mut self, elapsed: f64, position: &[Option<f64>], variances: &[f64]) {
        self.course.advance(&self.parameters, elapsed, position, variances);
    }

    /// The movement so far.
    #[must_use]
    pub const fn course(&self) -> &Course {
        &self.course
    }

    /// Other destinations, in mid-movement too.
    pub fn replan(&mut self, destinations: &Destinations) {
        let d = self.course.dimensions();
        let log_volume = self.parameters.start.log_volume(d);
        self.log_start.clear();
        self.log_near.clear();
        for i in 0..destinations.len() {
            let offset = minus(&vector(destinations.center(i)), &self.course.start);
            self.log_start.push(evidence::log_start(&self.parameters.start, &offset) - log_volume);
            self.log_near.push(evidence::log_near(self.parameters.near, &offset, destinations.kind(i), d));
        }
    }

    /// `g (ln N_i - ln S_i) + B_i` for every destination; zero after the first observation alone.
    pub fn log_likelihoods(&mut self, destinations: &Destinations, into: &mut Vec<f64>) {
        let parameters = &*self.parameters;
        into.clear();
        if self.course.observations < 2 {
            into.resize(destinations.len(), 0.0);
            return;
        }
        let power = parameters.power.after(self.course.elapsed);
        self.nodes().log_densities(destinations, &mut self.log_endpoint);
        let direction = evidence::DirectionNow::new(&parameters.direction, &self.course);
        let each = self.log_endpoint.iter().zip(&self.log_start).enumerate();
        into.extend(each.map(|(i, (endpoint, start))| {
            let offset = minus(&vector(destinations.center(i)), &self.course.start);
            let seen = direction.log_evidence(&offset, &destinations.kind(i).covariance);
            let whole = power * (endpoint - start) + seen;
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

    /// `ln (m^2 / (m^2 + near^2))` for every destination: part of the prior, once the start is known.
    #[must_use]
    pub fn log_near(&self) -> &[f64] {
        &self.log_near
    }

    /// The pairs of noise scale and time to go after the latest observation.
    #[must_use]
    pub fn nodes(&self) -> Nodes {
        Nodes::new(&self.parameters, &self.course)
    }

    /// The constants.
    #[must_use]
    pub fn parameters(&self) -> &Parameters {
        &self.parameters
    }
}
