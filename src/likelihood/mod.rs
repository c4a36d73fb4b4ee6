//! `log p(y_2:k | y_1, D_i, T_n)`: Liang (5), by six methods behind one trait.
//!
//! | `method` | file | family |
//! |---|---|---|
//! | `pseudoObservation` | [`pseudo_observation`] | pseudo-observation, in closed form |
//! | `algorithm1` | [`algorithm1`] | pseudo-observation, Liang (10)-(11) |
//! | `algorithm2` | [`algorithm2`] | pseudo-observation, Liang (12)-(13) |
//! | `bridging` | [`bridging`] | independent endpoint, the original bridging distributions |
//! | `singleFilter` | [`single_filter`] | independent endpoint, Ardeshiri (12) |
//! | `singleFilterApproximate` | [`single_filter`] | Ardeshiri (15), Table 1 |
//!
//! Within a family the methods give the same numbers to rounding; the families differ from each other. Each gives the states of its
//! own family too. Observations at one time are observations each, as in the papers: two of one place are more evidence than one.

pub mod algorithm1;
pub mod algorithm2;
pub mod bridging;
pub(crate) mod configuration;
pub(crate) mod expiring;
pub(crate) mod filter_bank;
pub(crate) mod node_posterior;
pub(crate) mod plan;
pub mod pseudo_observation;
pub mod single_filter;
pub(crate) mod states;
pub(crate) mod stepwise;

use crate::error::Result;
use crate::math::gaussian::Gaussian;
use crate::math::kalman::{Filter, Measurement};
use crate::model::destination::Destinations;
use crate::model::endpoint::Endpoint;
use crate::model::motion::{MotionModel, Transition};
use crate::value::{Node, Value};
use nalgebra::{DMatrix, DVector};
use plan::{Group, Plan};
use states::{StateQuery, States};
use std::fmt;

/// The six methods of the papers.
///
/// | method | cost of an observation |
/// |---|---|
/// | `PseudoObservation` (default) | one filter, two densities for each destination and arrival time: the numbers of the algorithms |
/// | `Algorithm1`, `Algorithm2` | Liang's, step by step: one update for each, or two |
/// | `Bridging` | a filter for each destination and arrival time |
/// | `SingleFilter`, `SingleFilterApproximate` | Ardeshiri's: one filter, closed forms |
///
/// ```
/// assert_eq!(whither::Method::SingleFilter.name(), "singleFilter"); // as JSON spells it
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Method {
    /// The telescoped form of Liang's prediction errors: one filter, then two densities for each destination and node.
    PseudoObservation,
    /// Liang (10)-(11).
    Algorithm1,
    /// Liang (12)-(13), with the sign of `M(h)` put right.
    Algorithm2,
    /// The original bridging distributions: a Kalman filter on `[x_k; G~ x_T]` for each destination and node.
    Bridging,
    /// Ardeshiri (12) exactly.
    SingleFilter,
    /// Ardeshiri (15): the denominator `f(x_T given x_1)` taken as constant.
    SingleFilterApproximate,
}

impl Method {
    /// The methods as they are spelt in a scenario.
    pub(crate) const NAMES: [(&'static str, Self); 6] = [
        ("pseudoObservation", Self::PseudoObservation),
        ("algorithm1", Self::Algorithm1),
        ("algorithm2", Self::Algorithm2),
        ("bridging", Self::Bridging),
        ("singleFilter", Self::SingleFilter),
        ("singleFilterApproximate", Self::SingleFilterApproximate),
    ];

    /// As it is spelt in a scenario.
    #[must_use]
    pub fn name(self) -> &'static str {
        Self::NAMES.iter().find(|(_, method)| *method == self).map_or("", |(name, _)| name)
    }

    /// Whether evidence is accumulated for each destination and node, so that neither may change in mid-movement.
    #[must_use]
    pub const fn accumulates(self) -> bool {
        matches!(self, Self::Algorithm1 | Self::Algorithm2 | Self::Bridging)
    }

    /// The likelihoods at the first observation.
    pub(crate) fn likelihood(self) -> Box<dyn Likelihood> {
        match self {
            Self::PseudoObservation => Box::new(pseudo_observation::dense::Dense),
            Self::Algorithm1 => Box::<algorithm1::Algorithm1>::default(),
            Self::Algorithm2 => Box::<algorithm2::Algorithm2>::default(),
            Self::Bridging => Box::<bridging::Bridging>::default(),
            Self::SingleFilter => Box::new(single_filter::SingleFilter),
            Self::SingleFilterApproximate => Box::new(single_filter::SingleFilterApproximate),
        }
    }
}

/// What a method computes from: the models, the destinations with their nodes, and the filter now.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Scene<'a> {
    /// The motion model.
    pub motion: &'a dyn MotionModel,
    /// The destinations.
    pub destinations: &'a Destinations,
    /// Their arrival nodes.
    pub plan: &'a Plan,
    /// `p(x_1 | y_1)`; `p(x_1)` where the first observation's evidence counts.
    pub first: &'a Gaussian,
    /// The Kalman posterior after the latest observation.
    pub filter: &'a Filter,
    /// `t_k - t_1`.
    pub elapsed: f64,
}

/// One step from `t_{k-1}` to `t_k`, for the methods that accumulate.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Step<'a> {
    /// The posterior at `t_{k-1}`.
    pub before: &'a Filter,
    /// The prediction for `t_k`, before the correction.
    pub predicted: &'a Filter,
    /// `F(h), M(h), Q(h)`.
    pub transition: &'a Transition,
    /// `y_k`.
    pub measurement: &'a Measurement,
    /// `t_{k-1} - t_1`.
    pub elapsed_before: f64,
}

/// A method: turns a movement so far into `log p(y_2:k | y_1, D_i, T_n)`.
pub(crate) trait Likelihood: Send + Sync {
    /// Begins a movement at its first observation.
    fn begin(&mut self, _scene: &Scene<'_>) {}

    /// Takes one more observation in; `scene` is as after it.
    fn advance(&mut self, _scene: &Scene<'_>, _step: &Step<'_>) {}

    /// Writes `log p(y_2:k | y_1, D_i, T_n)` for every destination and node, laid out as [`Plan::rows`] is; minus infinity
    /// for nodes that have passed. Of `y_1:k` where the first observation's evidence counts; where it does not, never called for
    /// the first observation.
    fn log_likelihoods(&self, scene: &Scene<'_>, table: &mut [f64]);

    /// The state given a destination and an arrival time, as this method's family constructs the endpoint; none where it has
    /// no density there. Computed by the method of [`StateQuery::evidence`].
    fn states(&self, query: &StateQuery<'_>) -> Option<States> {
        query.given_pseudo_observation()
    }

    /// A copy of its own.
    fn boxed(&self) -> Box<dyn Likelihood>;

    /// What it has accumulated, for a snapshot.
    fn save(&self) -> Value {
        Value::Null
    }

    /// Takes back what [`Likelihood::save`] gave.
    ///
    /// # Errors
    /// Those of reading a value.
    fn load(&mut self, _scene: &Scene<'_>, _node: &Node<'_>) -> Result<()> {
        Ok(())
    }
}

impl fmt::Debug for dyn Likelihood + '_ {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("Likelihood")
    }
}

/// One node of one group: everything that its destinations share there.
#[derive(Clone, Debug)]
pub(crate) struct NodeOfGroup<'a> {
    pub group: &'a Group,
    /// The destinations of the group.
    pub members: &'a [u32],
    /// The node's place in its grid.
    pub index: usize,
    /// A number of its own for each (group, node), counting over all of the plan.
    pub number: usize,
    /// `T_n - t_k`, above zero.
    pub remaining: f64,
    /// `T_n - t_1`.
    pub since_first: f64,
    /// The endpoint's covariance `S_i`.
    pub covariance: DMatrix<f64>,
}

impl<'a> Scene<'a> {
    /// The (group, node) pairs that have not passed at `elapsed`.
    pub(crate) fn nodes_ahead(self, elapsed: f64) -> impl Iterator<Item = NodeOfGroup<'a>> {
        let mut first_number = 0;
        self.plan.groups.iter().enumerate().flat_map(move |(g, group)| {
            let times = &self.plan.grids[group.grid].times;
            let base = first_number;
            first_number += times.len();
            let class = &self.destinations.classes()[group.class];
            let members = self.plan.members.of(g);
            times.iter().enumerate().filter_map(move |(index, &time)| {
                let remaining = self.plan.remaining(group.grid, time, elapsed);
                (remaining > 0.0).then(|| NodeOfGroup {
                    group,
                    members,
                    index,
                    number: base + index,
                    remaining,
                    since_first: self.plan.since_first(group.grid, time, elapsed),
                    covariance: class.covariance(),
                })
            })
        })
    }

    /// How many (group, node) pairs there are.
    pub(crate) fn node_count(self) -> usize {
        self.plan.groups.iter().map(|group| self.plan.grids[group.grid].times.len()).sum()
    }

    /// The length of a table over all destinations and nodes.
    pub(crate) fn table_length(self) -> usize {
        self.plan.rows.last().copied().unwrap_or(0)
    }

    /// Copies what was accumulated for the nodes that have not passed; minus infinity for the others.
    pub(crate) fn copy_nodes_ahead(self, accumulated: &[f64], table: &mut [f64]) {
        table.fill(f64::NEG_INFINITY);
        for node in self.nodes_ahead(self.elapsed) {
            for &i in node.members {
                let place = self.plan.rows[i as usize] + node.index;
                table[place] = accumulated[place];
            }
        }
    }

    /// The endpoint's prediction error for destination `i` from a state.
    pub(crate) fn endpoint_error(self, i: usize, endpoint: &Endpoint, state: &DVector<f64>) -> DVector<f64> {
        endpoint.error(self.destinations.mean(i), state, self.destinations.center(i))
    }
}
