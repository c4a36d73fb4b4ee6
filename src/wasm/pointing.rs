//! Bindings behind `js/pointing/`: the pointing engine on a screen, numbers in and out.
//!
//! JavaScript has checked every number before it enters here: nothing in this file can fail. What it reads are flat lists:
//!
//! | list | numbers |
//! |---|---|
//! | `constants` | as [`constants`] returns them |
//! | `targets` | of each target `x`, `y`, width, height, prior |

use crate::Learnt;
use crate::pointing::defaults::{OBSERVATION_NOISE, REMAINING};
use crate::pointing::entry_time::EntryTime;
use crate::pointing::parameters::PointingConstants;
use crate::pointing::sizes::Sizes;
use crate::pointing::space::Plane;
use crate::pointing::targets::{Extent, Target, Targets};
use crate::pointing::{Lasting, Pointing};
use crate::posterior::shares;
use std::sync::Arc;
use wasm_bindgen::prelude::wasm_bindgen;

/// Small rather than fast, and without joining what is freed: a step allocates nothing, and no object here is large.
#[global_allocator]
static ALLOCATOR: rlsf::SmallGlobalTlsf = rlsf::SmallGlobalTlsf::new();

/// State of a JavaScript `PointerPredictor`.
#[wasm_bindgen]
#[derive(Clone, Debug)]
pub struct PointerEngine {
    parameters: Arc<PointingConstants>,
    /// Of an observation, in each axis.
    variances: [f64; 2],
    /// The prior probability of none of the targets.
    prior_none: f64,
    /// Whether movements keep what can be learnt from.
    learning: bool,
    learnt: Learnt,
    /// The same for JavaScript.
    learnt_numbers: [f64; 7],
    targets: Arc<Targets>,
    movement: Option<Box<Pointing<Plane>>>,
    /// What outlasted the movements before.
    lasting: Lasting,
    probabilities: Vec<f64>,
    none: f64,
    /// Whether the probabilities are older than the last observation or change.
    stale: bool,
}

#[wasm_bindgen]
impl PointerEngine {
    /// Before the first observation.
    #[wasm_bindgen(constructor)]
    pub fn new(constants: &[f64], targets: &[f64]) -> PointerEngine {
        let Constants { none, parameters, deviations, .. } = Constants::read(constants);
        Self {
            parameters: Arc::new(parameters),
            variances: deviations.map(|deviation| deviation * deviation),
            prior_none: none,
            learning: false,
            learnt: Learnt::default(),
            learnt_numbers: [0.0; 7],
            targets: read_targets(targets),
            movement: None,
            lasting: Lasting::default(),
            probabilities: Vec::new(),
            none,
            stale: true,
        }
    }

    /// A second engine in the same state.
    pub fn duplicate(&self) -> PointerEngine {
        self.clone()
    }

    /// Other targets, in mid-movement too.
    pub fn set_targets(&mut self, targets: &[f64]) {
        self.targets = read_targets(targets);
        self.stale = true;
        if let Some(movement) = &mut self.movement {
            movement.replan(Arc::clone(&self.targets));
        }
    }

    /// An observation, `elapsed` seconds after the first one, which has both axes; NaN marks one that is missing.
    pub fn observe(&mut self, elapsed: f64, x: f64, y: f64) {
        self.stale = true;
        if let Some(movement) = &mut self.movement {
            let axis = |x: f64| if x.is_nan() { None } else { Some(x) };
            movement.advance(elapsed, &[axis(x), axis(y)], &self.variances);
            return;
        }
        let (parameters, targets) = (Arc::clone(&self.parameters), Arc::clone(&self.targets));
        let mut movement = Pointing::begin(Plane, parameters, targets, &[x, y], &self.variances);
        movement.carry(&self.lasting);
        movement.apply(&self.learnt);
        if self.learning {
            movement.keep_trail();
        }
        self.movement = Some(Box::new(movement));
    }

    fn refresh(&mut self) {
        if !std::mem::take(&mut self.stale) {
            return;
        }
        if self.targets.len() == 0 {
            self.probabilities.clear();
            self.none = 1.0;
            return;
        }
        self.none = self.prior_none;
        match &mut self.movement {
            Some(movement) => self.none = movement.posterior(self.prior_none, &mut self.probabilities),
            None => shares::prior(self.targets.priors(), self.prior_none, &mut self.probabilities),
        }
    }

    /// The targets with their shares of the probability that is not none, or one of them alone.
    fn shares(&self, movement: &Pointing<Plane>, only: Option<usize>) -> Vec<(usize, f64)> {
        shares::beside_none(&self.probabilities, self.targets.priors(), only, || {
            let mut log_likelihoods = Vec::new();
            movement.log_likelihoods(&mut log_likelihoods);
            log_likelihoods
        })
    }

    /// The address of the targets' probabilities.
    pub fn probabilities(&mut self) -> *const f64 {
        self.refresh();
        self.probabilities.as_ptr()
    }

    /// The probability of none of the targets.
    pub fn none(&mut self) -> f64 {
        self.refresh();
        self.none
    }

    /// The time to the entry into the target: median, low, high; empty before the second observation and without targets.
    pub fn remaining(&mut self) -> Vec<f64> {
        self.refresh();
        let can_enter = |movement: &&Pointing<Plane>| movement.course().observations > 1 && self.targets.len() > 0;
        let Some(movement) = self.movement.as_deref().filter(can_enter) else {
            return Vec::new();
        };
        let time = movement.entry_time(&self.shares(movement, None));
        time.map_or(Vec::new(), |numbers| numbers.to_vec())
    }

    /// The state some seconds after the latest observation, mean and covariance; empty before the first observation and
    /// without targets.
    pub fn forecast(&mut self, later: f64) -> Vec<f64> {
        self.refresh();
        let Some(movement) = self.movement.as_deref() else { return Vec::new() };
        let state = movement.state(&self.shares(movement, None), later);
        let Some(state) = state else { return Vec::new() };
        let mut numbers = state.mean().to_vec();
        state.covariance().for_each(|row| numbers.extend_from_slice(row));
        numbers
    }

    /// The expected positions on the way to one target, each some seconds after the latest observation; empty before the first
    /// observation.
    pub fn path(&mut self, target: usize, later: &[f64]) -> Vec<f64> {
        self.refresh();
        let mut path = Vec::with_capacity(2 * later.len());
        let Some(movement) = self.movement.as_deref() else { return path };
        for &later in later {
            let towards = |only: Option<usize>| movement.state(&self.shares(movement, only), later);
            if let Some(state) = towards(Some(target)).or_else(|| towards(None)) {
                path.extend_from_slice(&state.mean()[..2]);
            }
        }
        path
    }

    /// Movements keep from now on what can be learnt from.
    pub fn keep_trails(&mut self) {
        self.learning = true;
    }

    /// Learns that the movement goes to a target.
    pub fn chosen(&mut self, target: usize) {
        self.stale = true;
        if let Some(movement) = &mut self.movement {
            movement.learn(target, &mut self.learnt);
        }
    }

    /// The address of what was learnt of the user, seven numbers.
    pub fn learnt(&mut self) -> *const f64 {
        self.learnt_numbers = self.learnt.numbers();
        self.learnt_numbers.as_ptr()
    }

    /// Goes on with what JavaScript wrote where [`PointerEngine::learnt`] points to.
    pub fn apply_learnt(&mut self) {
        self.stale = true;
        self.learnt = Learnt::of(self.learnt_numbers);
        if let Some(movement) = &mut self.movement {
            movement.apply(&self.learnt);
        }
    }

    /// Ends the movement.
    pub fn reset(&mut self) {
        if let Some(movement) = self.movement.take() {
            self.lasting = movement.course().lasting();
        }
        self.stale = true;
    }
}

/// The default constants in the order of `js/pointing/constants.ts`; the noise scales come last.
#[wasm_bindgen]
pub fn constants() -> Vec<f64> {
    let mut constants = Constants::default();
    let mut flat = constants.places().map(|place| *place).to_vec();
    flat.extend(constants.parameters.scales);
    flat
}

/// All constants, as numbers that can be listed.
struct Constants {
    /// The prior probability of none of the targets.
    none: f64,
    parameters: PointingConstants,
    entry: EntryTime,
    points: f64,
    /// Of an observation, in each axis.
    deviations: [f64; 2],
}

impl Default for Constants {
    fn default() -> Self {
        let parameters = PointingConstants::default();
        let points = parameters.time_to_go.points as f64;
        Self { none: 0.0, parameters, entry: REMAINING, points, deviations: [OBSERVATION_NOISE; 2] }
    }
}

impl Constants {
    /// What [`constants`] returned, with some others in their place.
    fn read(flat: &[f64]) -> Self {
        let mut constants = Self::default();
        let mut numbers = flat.iter();
        constants.places().into_iter().zip(&mut numbers).for_each(|(place, x)| *place = *x);
        let scales = numbers.copied().collect();
        let Self { parameters, entry, points, .. } = &mut constants;
        (parameters.scales, parameters.remaining) = (scales, Some(entry.clone()));
        parameters.time_to_go.points = *points as usize;
        constants
    }

    /// The numbers in their order.
    fn places(&mut self) -> [&mut f64; 41] {
        let Self { none, parameters: p, entry, points, deviations: [deviation_x, deviation_y] } = self;
        let ([speed_x, speed_y, _], time, direction) = (&mut p.first_speed, &mut p.time_to_go, &mut p.direction);
        [
            none,
            &mut p.filter_noise,
            &mut p.speed_noise,
            deviation_x,
            deviation_y,
            speed_x,
            speed_y,
            &mut p.along_noise,
            &mut p.across_noise,
            &mut time.from,
            &mut time.to,
            points,
            &mut time.median,
            &mut time.spread,
            &mut time.speed_exponent,
            &mut p.start.exponent,
            &mut p.start.core,
            &mut p.start.reach,
            &mut direction.power,
            &mut direction.core,
            &mut direction.wide,
            &mut direction.distance,
            &mut direction.time,
            &mut p.power.from,
            &mut p.power.to,
            &mut p.power.time,
            &mut p.near,
            &mut p.rest_distance,
            &mut p.shake,
            &mut p.none_gain,
            &mut p.none_offset,
            &mut p.none_share,
            &mut p.uniform,
            &mut p.unit,
            &mut entry.offset,
            &mut entry.nodes,
            &mut entry.near,
            &mut entry.distance,
            &mut entry.elapsed,
            &mut entry.low,
            &mut entry.high,
        ]
    }
}

fn read_targets(flat: &[f64]) -> Arc<Targets> {
    let targets = flat.as_chunks().0;
    let mut sizes = Sizes::among(targets.len());
    let list: Vec<_> = targets
        .iter()
        .map(|&[x, y, width, height, prior]| Target {
            center: [x, y, 0.0],
            extent: sizes.number([width, height]),
            prior,
        })
        .collect();
    let extents = sizes.list().iter().map(|&sides| Extent::of_box(sides));
    Arc::new(Targets::new(2, extents.collect(), list.into_iter()))
}
