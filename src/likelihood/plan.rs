//! Which arrival times are tried for which destination: the nodes of (6), and the destinations that share them.

use crate::math::quadrature::Quadrature;
use crate::model::arrival::{Arrival, Grid};
use crate::model::destination::Destinations;
use fnv::FnvHashMap;

/// Destinations that have both the arrival nodes and the class of endpoint in common: every matrix serves all of them.
#[derive(Clone, Debug)]
pub(crate) struct Group {
    /// Which grid of nodes.
    pub grid: usize,
    /// Which class of endpoint.
    pub class: usize,
    /// The destinations.
    pub members: Vec<u32>,
}

/// The arrival nodes of all destinations. Times count from the first observation, or from now for a `horizon`.
#[derive(Clone, Debug)]
pub(crate) struct Plan {
    /// The distinct grids.
    pub grids: Vec<Grid>,
    /// The destinations by grid and class.
    pub groups: Vec<Group>,
    /// The grid of each destination.
    pub grid_of: Vec<u32>,
    /// Where each destination's row begins in a table over all its nodes, and at last the length of that table.
    pub rows: Vec<usize>,
    /// Whether a grid counts from now, not from the first observation.
    horizons: Vec<bool>,
    /// Whether a grid has a destination whose prior is above zero.
    possible: Vec<bool>,
}

impl Plan {
    /// The nodes for `destinations`, whose arrival priors are their own or `arrival`; `start` is the first position.
    pub fn new(destinations: &Destinations, arrival: &Arrival, quadrature: &Quadrature, start: &[f64]) -> Self {
        let mut plan = Self {
            grids: Vec::new(),
            groups: Vec::new(),
            grid_of: Vec::with_capacity(destinations.len()),
            rows: vec![0],
            horizons: Vec::new(),
            possible: Vec::new(),
        };
        let classes = destinations.classes();
        // a grid for each class's own prior, one for all that have none; a grid for each destination under Fitts's law
        let mut shared: Vec<Option<u32>> = vec![None; classes.len()];
        let mut default: Option<u32> = None;
        let mut groups = FnvHashMap::default();
        for i in 0..destinations.len() {
            let number = destinations.class_number(i);
            let class = &classes[number];
            let prior = class.arrival().unwrap_or(arrival);
            let known = if class.arrival().is_some() { &mut shared[number] } else { &mut default };
            let grid = match *known {
                Some(grid) if !prior.needs_distance() => grid,
                _ => {
                    let center = destinations.center(i);
                    let offsets = center.iter().zip(start).map(|(a, y)| (a - y) * (a - y));
                    let distance = offsets.sum::<f64>().sqrt();
                    plan.horizons.push(prior.is_horizon());
                    plan.possible.push(false);
                    plan.grids.push(prior.grid(quadrature, distance, class.extent(destinations.dimensions())));
                    plan.grids.len() as u32 - 1
                }
            };
            *known = Some(grid);
            plan.possible[grid as usize] |= destinations.priors()[i] > 0.0;
            let group = *groups.entry((grid as usize, number)).or_insert(plan.groups.len());
            if group == plan.groups.len() {
                plan.groups.push(Group { grid: grid as usize, class: number, members: Vec::new() });
            }
            plan.groups[group].members.push(i as u32);
            plan.grid_of.push(grid);
            plan.rows.push(plan.rows[i] + plan.grids[grid as usize].times.len());
        }
        plan
    }

    /// The nodes of destination `i`.
    pub fn grid(&self, i: usize) -> &Grid {
        &self.grids[self.grid_of[i] as usize]
    }

    /// Whether the times of `grid` count from now.
    pub fn is_horizon(&self, grid: usize) -> bool {
        self.horizons[grid]
    }

    /// The time from `elapsed` until a node of `grid`; zero or less where it has passed.
    pub fn remaining(&self, grid: usize, time: f64, elapsed: f64) -> f64 {
        if self.horizons[grid] { time } else { time - elapsed }
    }

    /// A node of `grid` as a time since the first observation, from `elapsed` on where it counts from now.
    pub fn since_first(&self, grid: usize, time: f64, elapsed: f64) -> f64 {
        if self.horizons[grid] { time + elapsed } else { time }
    }

    /// Whether some destination of `grid` has a prior above zero.
    pub fn is_possible(&self, grid: usize) -> bool {
        self.possible[grid]
    }

    /// Whether some node that has weight, of a destination that has, still lies after `elapsed`.
    pub fn is_alive(&self, elapsed: f64) -> bool {
        self.grids.iter().enumerate().any(|(g, grid)| {
            let mut nodes = grid.times.iter().zip(&grid.log_weights);
            self.possible[g]
                && nodes.any(|(&time, &weight)| weight > f64::NEG_INFINITY && self.remaining(g, time, elapsed) > 0.0)
        })
    }
}
