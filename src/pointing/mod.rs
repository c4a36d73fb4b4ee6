//! The pointing model: where a hand or a pointer is going. Ours, beyond the papers.
//!
//! It keeps their structure, a filter and a closed-form density of the endpoint summed over the time to go, against what
//! is known of the endpoint from the start alone, and replaces what recorded hands contradict:
//!
//! | part | what it is for | where |
//! |---|---|---|
//! | filter | a hand that moves fast changes its velocity more than one that rests | `course` |
//! | endpoint density | where the movement would end if it went on, some time from now, wider along the way than across | `endpoint` |
//! | start density | what was already likely before the movement: near targets are many, far ones few | `evidence` |
//! | direction | the way covered so far points at the target, the better the farther one has come | `evidence` |
//! | power | the first samples carry less evidence than the model has it, the later ones more | [`parameters::Power`] |
//! | near | a movement seldom ends where it began | `evidence` |
//! | shake | in a car the observed position is not the hand's alone; only where a scenario asks for it | `shake` |
//! | onset | a pointer that rests from the start on has not begun a movement, and may mean what it rests on | `course` |
//! | confidence | users differ in how far all of this holds for them: the log score times a factor that outcomes teach | `learning`, `trail` |
//!
//! `targets` and `kernel` compute it for all destinations at once; the other parts one destination at
//! a time, for the log likelihoods and everything else.
//!
//! Nothing is accumulated for a destination, so destinations may come, go and move at any time.

pub(crate) mod course;
pub(crate) mod defaults;
mod destinations;
pub(crate) mod endpoint;
pub(crate) mod engine;
pub mod entry_time;
pub(crate) mod evidence;
mod form;
pub(crate) mod from_start;
pub(crate) mod kernel;
mod learning;
pub mod parameters;
mod posterior;
pub(crate) mod shake;
#[cfg(any(test, feature = "wasm-pointing"))]
pub(crate) mod sizes;
pub(crate) mod space;
mod state;
pub(crate) mod targets;
mod trail;

pub(crate) use crate::engine::Lasting;
use crate::math::log_sum_exp::share;
use crate::model::learnt::Learnt;
use course::{Course, Onset};
use endpoint::Nodes;
use evidence::{DirectionNow, log_start, near};
use from_start::FromStart;
use kernel::{Now, Total, Work};
use parameters::PointingConstants;
use space::Space;
use std::sync::Arc;
use targets::Targets;
use trail::Trail;
pub(crate) use whither_kernel::small_gaussian::Symmetric;

/// A position, velocity or offset; components beyond the dimensions are zero.
pub type Vector = [f64; 3];

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
pub(crate) struct Pointing<S> {
    parameters: Arc<PointingConstants>,
    targets: Arc<Targets>,
    /// That of the start density.
    log_volume: f64,
    course: Course<S>,
    nodes: Nodes<S>,
    from_start: FromStart,
    work: Work,
    /// What is known of the user.
    learnt: Learnt,
    /// What is kept for [`Pointing::learn`], where it is and was not used yet.
    trail: Option<Box<Trail>>,
}

impl<S: Space> Pointing<S> {
    /// Begins at the first observation, of variance `variances` in each axis.
    #[must_use]
    pub fn begin(
        space: S,
        parameters: Arc<PointingConstants>,
        targets: Arc<Targets>,
        position: &[f64],
        variances: &[f64],
    ) -> Self {
        let course = Course::begin(space, &parameters, position, variances);
        Self::resume(parameters, targets, course)
    }

    /// Goes on from a course that was saved.
    #[must_use]
    pub fn resume(parameters: Arc<PointingConstants>, targets: Arc<Targets>, course: Course<S>) -> Self {
        let (nodes, from_start) = (Nodes::new(&parameters, &course), FromStart::of(&targets, course.dimensions()));
        let log_volume = parameters.start.log_volume(course.dimensions());
        Self {
            parameters,
            targets,
            log_volume,
            course,
            nodes,
            from_start,
            work: Work::default(),
            learnt: Learnt::default(),
            trail: None,
        }
    }

    /// Takes in one more observation, `elapsed` seconds after the first one; none marks an axis that was not observed. At the time
    /// of the last one it replaces that.
    pub fn advance(&mut self, elapsed: f64, position: &[Option<f64>], variances: &[f64]) {
        self.course.advance(&self.parameters, elapsed, position, variances);
        if self.course.observations < 2 {
            self.from_start.forget();
        }
        self.nodes.refresh(&self.parameters, &self.course);
        if let Some(trail) = &mut self.trail {
            trail.keep(&self.course);
        }
    }

    /// Begins with what outlasted an earlier movement, [`Course::lasting`].
    pub fn carry(&mut self, lasting: &Lasting) {
        self.course.carry(lasting);
    }

    fn onset(&self) -> Onset {
        self.course.onset(&self.parameters)
    }

    /// The movement so far.
    #[must_use]
    pub const fn course(&self) -> &Course<S> {
        &self.course
    }

    /// The targets.
    #[must_use]
    pub fn targets(&self) -> &Targets {
        &self.targets
    }

    /// Other targets, in mid-movement too: nothing accumulates for any of them.
    pub fn replan(&mut self, targets: Arc<Targets>) {
        self.from_start = FromStart::of(&targets, self.course.dimensions());
        self.targets = targets;
    }

    /// Writes weights of the targets, `(prior_i near_i (N_i / S_i)^g e^B_i)^confidence` with one scale for all, and returns what they sum
    /// to; none where nothing is known of any of them.
    fn weights(&mut self, into: &mut Vec<f64>) -> Option<Total> {
        let (onset, d, confidence) = (self.onset(), self.course.dimensions(), self.confidence());
        let Self { parameters, targets, course, .. } = self;
        if course.observations > 1 {
            self.from_start.update(targets, parameters, self.log_volume, course, onset, confidence);
            let power = parameters.power.after(course.elapsed);
            let way = DirectionNow::new(parameters, course).way(power).times(confidence);
            let now = Now { nodes: &self.nodes, way: &way };
            let total = self.work.weights(targets, &self.from_start, &now, into);
            if total.is_some() {
                return total;
            }
        }
        self.log_likelihoods(into);
        let priors = self.targets.priors();
        let total: f64 = priors.iter().sum();
        // most are the same as the one before
        let (mut known, mut log_prior) = (f64::NAN, f64::NAN);
        for (i, (value, &prior)) in into.iter_mut().zip(priors).enumerate() {
            let offset = minus(&self.targets.center(i), &self.course.start);
            let log_near = near(&self.parameters, &offset, self.targets.extent(i), d).ln();
            if prior != known {
                (known, log_prior) = (prior, (prior / total).ln());
            }
            *value += confidence * (onset.share * log_near + log_prior);
        }
        share(into).map(|log_scale| Total { total: 1.0, log_scale })
    }

    /// The log score is multiplied by this: it holds from the second observation on.
    fn confidence(&self) -> f64 {
        if self.course.observations > 1 { self.learnt.confidence } else { 1.0 }
    }

    /// `g (ln N_i - ln S_i) + B_i` for every target, times the confidence; zero after the first observation alone.
    pub fn log_likelihoods(&self, into: &mut Vec<f64>) {
        let parameters = &*self.parameters;
        into.clear();
        if self.course.observations < 2 {
            into.resize(self.targets.len(), 0.0);
            return;
        }
        let power = parameters.power.after(self.course.elapsed);
        let direction = DirectionNow::new(parameters, &self.course);
        let (pairs, onset, confidence) = (self.nodes.pairs(), self.onset(), self.confidence());
        into.extend((0..self.targets.len()).map(|i| {
            let (center, extent) = (self.targets.center(i), self.targets.extent(i));
            let offset = minus(&center, &self.course.start);
            let start = log_start(&parameters.start, &offset, &onset) - self.log_volume;
            let evidence = direction.log_evidence(&offset, extent);
            let sum = confidence * (power * (pairs.log_density(&center, extent) - start) + evidence);
            // beyond the range of numbers, as far away and as fast as nothing on a screen, nothing is known
            if sum < f64::INFINITY { sum } else { f64::NEG_INFINITY }
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
    pub const fn nodes(&self) -> &Nodes<S> {
        &self.nodes
    }

    /// The constants.
    #[must_use]
    pub fn parameters(&self) -> &PointingConstants {
        &self.parameters
    }
}
