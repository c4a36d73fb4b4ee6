//! One movement under every noise candidate.
//!
//! Each candidate has its filter and its engine; what they say is averaged by evidence (Bayesian model averaging),
//! `p(y_2:k | y_1, D_i, T) = sum_c w_c p(y_2:k | y_1, D_i, T, c)`.

use super::plan::Plan;
use super::states::{StateQuery, States};
use super::{Likelihood, Method, NodeOfGroup, Scene, Step};
use crate::error::{Code, Error, Result};
use crate::math::gaussian::Gaussian;
use crate::math::kalman::{Filter, Measurement, TimeUpdate};
use crate::math::log_sum_exp::log_sum_exp;
use crate::model::destination::Destinations;
use crate::model::motion::{MotionModel, MotionModels, Transition};
use crate::value::{Node, Value};
use nalgebra::{DMatrix, DVector};
use std::sync::Arc;

/// The movement under one noise candidate.
///
/// ```
/// use nalgebra::{dmatrix, dvector};
/// use whither::{Gaussian, Scenario, likelihood::{candidates::Movement, plan::Plan}, scenario::Engine};
/// let scenario: Scenario = serde_json::from_str(r#"{
///     "motion": { "type": "brownian", "dimensions": 1, "noise": { "candidates": [1, 9], "weights": [1, 3] } },
///     "observation": { "noise": 1 },
///     "arrival": { "type": "discrete", "times": [2], "weights": [1] },
///     "destinations": [{ "id": "there", "mean": [4], "covariance": [[3]] }]
/// }"#).unwrap();
/// let Engine::Papers { method, arrival, quadrature, .. } = &scenario.engine else { panic!() };
/// let plan = Plan::new(&scenario.destinations, arrival, quadrature, &[0.0]);
/// let first = Gaussian { mean: dvector![0.0], covariance: dmatrix![1.0] };
/// let movement = Movement::begin(&scenario.motion, *method, &scenario.destinations, plan, first);
/// assert!((movement.worlds[0].log_weight - 0.25f64.ln()).abs() < 1e-14);
/// assert_eq!(movement.worlds[1].model.transition(2.0).noise[(0, 0)], 162.0); // 9^2 * 2
/// ```
#[derive(Debug)]
pub struct World {
    /// `ln w_c`.
    pub log_weight: f64,
    /// The motion model with this noise.
    pub model: Arc<dyn MotionModel>,
    /// Its Kalman posterior.
    pub filter: Filter,
    engine: Box<dyn Likelihood>,
}

impl Clone for World {
    fn clone(&self) -> Self {
        Self {
            log_weight: self.log_weight,
            model: Arc::clone(&self.model),
            filter: self.filter.clone(),
            engine: self.engine.boxed(),
        }
    }
}

/// A movement so far.
///
/// ```
/// use nalgebra::{dmatrix, dvector};
/// use whither::{Gaussian, Scenario, likelihood::{candidates::Movement, plan::Plan}, scenario::Engine};
/// let scenario: Scenario = serde_json::from_str(r#"{
///     "motion": { "type": "brownian", "dimensions": 1, "noise": 1 }, "observation": { "noise": 1 },
///     "arrival": { "type": "discrete", "times": [2], "weights": [1] },
///     "destinations": [{ "id": "there", "mean": [4], "covariance": [[3]] }]
/// }"#).unwrap();
/// let Engine::Papers { method, arrival, quadrature, .. } = &scenario.engine else { panic!() };
/// let plan = Plan::new(&scenario.destinations, arrival, quadrature, &[0.0]);
/// let first = Gaussian { mean: dvector![0.0], covariance: dmatrix![1.0] };
/// let mut movement = Movement::begin(&scenario.motion, *method, &scenario.destinations, plan, first);
/// let measurement = scenario.observation.measurement(&[Some(3.0)], None).unwrap();
/// movement.advance(&scenario.destinations, 1.0, &measurement).unwrap();
/// // N(0, 1) has become N(0, 2); of 3, seen with the variance 1, two thirds are believed
/// assert!((movement.worlds[0].filter.mean(0)[0] - 2.0).abs() < 1e-14);
/// ```
#[derive(Clone, Debug)]
pub struct Movement {
    /// The arrival nodes.
    pub plan: Plan,
    /// `p(x_1 | y_1)`; `p(x_1)` where the first observation's evidence counts.
    pub first: Gaussian,
    /// Whether the first observation's evidence counts: likelihoods are of `y_1:k`, not of `y_2:k` given `y_1`.
    pub first_counts: bool,
    /// One for each noise candidate.
    pub worlds: Vec<World>,
    /// `t_k - t_1`.
    pub elapsed: f64,
    /// `k`, the number of observations.
    pub observations: u64,
}

impl Movement {
    /// A movement at its first observation.
    #[must_use]
    pub fn begin(
        motion: &MotionModels,
        method: Method,
        destinations: &Destinations,
        plan: Plan,
        first: Gaussian,
    ) -> Self {
        let columns = if motion.depends_on_destination() { destinations.len() } else { 1 };
        let worlds = motion.candidates.iter().map(|candidate| World {
            log_weight: candidate.weight.ln(),
            model: Arc::clone(&candidate.model),
            filter: Filter::new(&first, columns),
            engine: method.engine(),
        });
        let mut movement =
            Self { plan, worlds: worlds.collect(), first, first_counts: false, elapsed: 0.0, observations: 1 };
        movement
            .each_engine(destinations, |engine, scene| {
                engine.begin(scene);
                Ok(())
            })
            .unwrap_or_default();
        movement
    }

    /// The movement as it is before its first observation, which [`Movement::advance`] then takes in, no time having passed:
    /// what it began with is `p(x_1)`, and `p(y_1 | D_i, T)` of Liang (5) counts.
    #[must_use]
    pub fn before_first_observation(self) -> Self {
        Self { first_counts: true, observations: 0, ..self }
    }

    /// Whether something has been observed that counts as evidence.
    fn has_evidence(&self) -> bool {
        self.observations > u64::from(!self.first_counts)
    }

    /// Acts on every (group, node) pair that has not passed.
    pub(crate) fn each_node(&self, destinations: &Destinations, mut act: impl FnMut(&NodeOfGroup<'_>)) {
        let Some(world) = self.worlds.first() else { return };
        let scene = self.scene(world, destinations);
        scene.nodes_ahead(self.elapsed).for_each(|node| act(&node));
    }

    /// The states `later` seconds after `now` under noise candidate `c`, given `node` and each of `members`; the likelihoods
    /// are those of this movement.
    pub(crate) fn states(
        &self,
        now: &Self,
        destinations: &Destinations,
        c: usize,
        node: &NodeOfGroup<'_>,
        members: &[usize],
        later: f64,
    ) -> Option<States> {
        let (world, latest) = (self.worlds.get(c)?, now.worlds.get(c)?);
        let (believed, now) = (self.scene(world, destinations), now.scene(latest, destinations));
        world.engine.states(&StateQuery { now, believed, node, members, later })
    }

    fn scene<'a>(&'a self, world: &'a World, destinations: &'a Destinations) -> Scene<'a> {
        Scene {
            motion: world.model.as_ref(),
            destinations,
            plan: &self.plan,
            first: &self.first,
            filter: &world.filter,
            elapsed: self.elapsed,
        }
    }

    fn each_engine(
        &mut self,
        destinations: &Destinations,
        mut act: impl FnMut(&mut dyn Likelihood, &Scene<'_>) -> Result<()>,
    ) -> Result<()> {
        for World { model, filter, engine, .. } in &mut self.worlds {
            let scene = Scene {
                motion: model.as_ref(),
                destinations,
                plan: &self.plan,
                first: &self.first,
                filter,
                elapsed: self.elapsed,
            };
            act(engine.as_mut(), &scene)?;
        }
        Ok(())
    }

    /// Takes an observation in, `elapsed` seconds after the first one.
    ///
    /// # Errors
    /// `out-of-range` where the numbers grow beyond what can be computed with (a drift that explodes); nothing has changed
    /// then.
    pub fn advance(&mut self, destinations: &Destinations, elapsed: f64, measurement: &Measurement) -> Result<()> {
        let mut steps = Vec::with_capacity(self.worlds.len());
        for world in &self.worlds {
            let transition = world.model.transition(elapsed - self.elapsed);
            let mut predicted = world.filter.clone();
            predicted.predict(&TimeUpdate {
                transition: &transition.transition,
                offsets: &offsets(&transition, destinations, predicted.means.ncols()),
                noise: &transition.noise,
            });
            let corrected = correct(predicted.clone(), measurement)?;
            steps.push((transition, predicted, corrected));
        }
        let elapsed_before = std::mem::replace(&mut self.elapsed, elapsed);
        self.observations += 1;
        for (World { model, filter, engine, .. }, (transition, predicted, corrected)) in
            self.worlds.iter_mut().zip(steps)
        {
            let before = std::mem::replace(filter, corrected);
            let scene =
                Scene { motion: model.as_ref(), destinations, plan: &self.plan, first: &self.first, filter, elapsed };
            let step =
                Step { before: &before, predicted: &predicted, transition: &transition, measurement, elapsed_before };
            engine.advance(&scene, &step);
        }
        Ok(())
    }

    /// For each noise candidate `ln w_c + log p(y_2:k, T_n | y_1, D_i, c)`, laid out as [`Plan::rows`] says.
    pub fn joint(&self, destinations: &Destinations, tables: &mut Vec<Vec<f64>>) {
        let length = self.plan.rows.last().copied().unwrap_or(0);
        tables.resize_with(self.worlds.len(), Vec::new);
        for (world, table) in self.worlds.iter().zip(tables) {
            table.clear();
            table.resize(length, 0.0);
            if self.has_evidence() {
                world.engine.log_likelihoods(&self.scene(world, destinations), table);
            }
            for i in 0..self.plan.grid_of.len() {
                let row = &mut table[self.plan.rows[i]..self.plan.rows[i + 1]];
                for (value, log_prior) in row.iter_mut().zip(&self.plan.grid(i).log_weights) {
                    *value += world.log_weight + log_prior;
                    if value.is_nan() {
                        *value = f64::NEG_INFINITY;
                    }
                }
            }
        }
    }

    /// `log p(y_2:k | y_1)` where the object is going to none of them: the ratio of the telescoped form is one. A motion
    /// model that knows the destination is averaged over the destinations' centres by their priors.
    #[must_use]
    pub fn log_evidence_of_none(&self, priors: &[f64]) -> f64 {
        let total: f64 = priors.iter().sum();
        let mut terms = Vec::new();
        for world in &self.worlds {
            let evidence = &world.filter.log_evidence;
            if evidence.len() == 1 {
                terms.push(world.log_weight + evidence[0]);
            } else {
                let each = evidence.iter().zip(priors);
                terms.extend(each.map(|(evidence, prior)| world.log_weight + evidence + (prior / total).ln()));
            }
        }
        log_sum_exp(&terms)
    }

    /// Other destinations in mid-movement, where nothing is accumulated for each of them: `origin` tells which old one each
    /// new one was, where the motion model knows the destination.
    pub fn replan(&mut self, plan: Plan, origin: Option<&[usize]>) {
        self.plan = plan;
        let Some(origin) = origin else { return };
        for world in &mut self.worlds {
            let filter = &mut world.filter;
            filter.means = filter.means.select_columns(origin);
            filter.log_evidence = origin.iter().map(|&i| filter.log_evidence[i]).collect();
        }
    }

    /// What a snapshot keeps.
    #[must_use]
    pub fn save(&self) -> Value {
        let matrix = |m: &DMatrix<f64>| Value::exact_numbers(m.iter());
        let worlds = self.worlds.iter().map(|world| {
            Value::map([
                ("means", matrix(&world.filter.means)),
                ("root", matrix(&world.filter.root)),
                ("evidence", Value::exact_numbers(&world.filter.log_evidence)),
                ("engine", world.engine.save()),
            ])
        });
        Value::map([
            ("elapsed", Value::exact(self.elapsed)),
            ("observations", Value::Number(self.observations as f64)),
            ("firstMean", Value::exact_numbers(self.first.mean.iter())),
            ("firstCovariance", matrix(&self.first.covariance)),
            ("worlds", Value::List(worlds.collect())),
        ])
    }

    /// The movement that [`Movement::save`] wrote.
    ///
    /// # Errors
    /// Those of reading a value.
    pub fn load(
        node: &Node<'_>,
        motion: &MotionModels,
        method: Method,
        destinations: &Destinations,
        plan: Plan,
    ) -> Result<Self> {
        let fields = node.fields(&["elapsed", "observations", "firstMean", "firstCovariance", "worlds"])?;
        let s = motion.states();
        let first = Gaussian {
            mean: DVector::from_vec(fields.required("firstMean")?.exact_numbers(s)?),
            covariance: DMatrix::from_vec(s, s, fields.required("firstCovariance")?.exact_numbers(s * s)?),
        };
        let mut movement = Self::begin(motion, method, destinations, plan, first);
        movement.elapsed = fields.required("elapsed")?.exact()?;
        movement.observations = fields.positive("observations")? as u64;
        let list = fields.required("worlds")?;
        let items: Vec<Node<'_>> = list.items()?.collect();
        for (world, item) in movement.worlds.iter_mut().zip(&items) {
            let fields = item.fields(&["means", "root", "evidence", "engine"])?;
            let (columns, rows) = (world.filter.means.ncols(), 2 * s);
            let means = fields.required("means")?.exact_numbers(rows * columns)?;
            world.filter.means = DMatrix::from_vec(rows, columns, means);
            let root = fields.required("root")?.exact_numbers(rows * rows)?;
            world.filter.root = DMatrix::from_vec(rows, rows, root);
            world.filter.log_evidence = fields.required("evidence")?.exact_numbers(columns)?;
        }
        let mut engines = items.iter();
        movement.each_engine(destinations, |engine, scene| {
            match engines.next().and_then(|item| item.get("engine")) {
                Some(saved) => engine.load(scene, &saved),
                None => Ok(()),
            }
        })?;
        Ok(movement)
    }
}

/// One step of a filter whose motion model does not know the destination.
///
/// # Errors
/// As [`Movement::advance`].
pub fn advance_filter(
    filter: &Filter,
    model: &dyn MotionModel,
    step: f64,
    measurement: &Measurement,
) -> Result<Filter> {
    let transition = model.transition(step);
    let offsets = DMatrix::from_column_slice(transition.offset.len(), 1, transition.offset.as_slice());
    let mut filter = filter.clone();
    let (transition, noise) = (&transition.transition, &transition.noise);
    filter.predict(&TimeUpdate { transition, offsets: &offsets, noise });
    correct(filter, measurement)
}

fn correct(mut filter: Filter, measurement: &Measurement) -> Result<Filter> {
    if filter.correct(measurement) && filter.is_finite() {
        return Ok(filter);
    }
    let message = "leads to a state that is not finite: the motion model explodes over this time";
    Err(Error::new(Code::OutOfRange, "time", message))
}

/// `M(h)` for every column of means.
fn offsets(transition: &Transition, destinations: &Destinations, columns: usize) -> DMatrix<f64> {
    if transition.destination_gain.is_none() {
        return DMatrix::from_column_slice(transition.offset.len(), 1, transition.offset.as_slice());
    }
    let each: Vec<DVector<f64>> = (0..columns).map(|i| transition.constant(&destinations.center(i))).collect();
    DMatrix::from_columns(&each)
}
