//! Which arrival times are tried for which destination: the nodes of (6), and the destinations that share them.

use crate::math::grouped::Grouped;
use crate::math::quadrature::Quadrature;
use crate::model::arrival::{Arrival, Grid};
use crate::model::destination::Destinations;

/// Destinations that have both the arrival nodes and the class of endpoint in common: every matrix serves all of them.
#[derive(Clone, Debug)]
pub(crate) struct Group {
    /// Which grid of nodes.
    pub grid: usize,
    /// Which class of endpoint.
    pub class: usize,
}

/// The arrival nodes of all destinations. Times count from the first observation, or from now for a `horizon`.
#[derive(Clone, Debug)]
pub(crate) struct Plan {
    /// The distinct grids.
    pub grids: Vec<Grid>,
    /// The destinations by grid and class, in the order of the first of each.
    pub groups: Vec<Group>,
    /// The destinations of each group.
    pub members: Grouped,
    /// The grid of each destination.
    pub grid_of: Vec<u32>,
    /// Where each destination's row begins in a table over all its nodes, and at last the length of that table.
    pub rows: Vec<usize>,
    /// Whether some grid depends on where the movement begins.
    pub depends_on_start: bool,
    /// Whether a grid counts from now, not from the first observation.
    horizons: Vec<bool>,
    /// Whether a grid has a destination whose prior is above zero.
    possible: Vec<bool>,
}

impl Plan {
    /// The nodes for `destinations`, whose arrival priors are their own or `arrival`; `start` is the first position.
    pub fn new(destinations: &Destinations, arrival: &Arrival, quadrature: &Quadrature, start: &[f64]) -> Self {
        let (count, d) = (destinations.len(), destinations.dimensions());
        let mut plan = Self {
            grids: Vec::new(),
            groups: Vec::new(),
            members: Grouped::default(),
            grid_of: Vec::with_capacity(count),
            rows: Vec::with_capacity(count + 1),
            depends_on_start: false,
            horizons: Vec::new(),
            possible: Vec::new(),
        };
        let classes = destinations.classes();
        // a grid for each class's own prior, one for all that have none; a grid, and so a group, for each destination under
        // Fitts's law
        let mut group_of_class: Vec<Option<usize>> = vec![None; classes.len()];
        let mut shared = None;
        let mut group_of = Vec::with_capacity(count);
        let mut row = 0;
        for i in 0..count {
            let number = destinations.class_number(i);
            let class = &classes[number];
            let prior = class.arrival().unwrap_or(arrival);
            let needs_distance = prior.needs_distance();
            let group = match group_of_class[number] {
                Some(group) if !needs_distance => group,
                _ => {
                    let is_shared = class.arrival().is_none() && !needs_distance;
                    let grid = match shared {
                        Some(grid) if is_shared => grid,
                        _ => plan.add_grid(prior, quadrature, distance(destinations.center(i), start), class.extent(d)),
                    };
                    if is_shared {
                        shared = Some(grid);
                    }
                    plan.depends_on_start |= needs_distance;
                    plan.groups.push(Group { grid, class: number });
                    plan.groups.len() - 1
                }
            };
            group_of_class[number] = Some(group);
            group_of.push(group as u32);
            let grid = plan.groups[group].grid;
            plan.possible[grid] |= destinations.priors()[i] > 0.0;
            plan.grid_of.push(grid as u32);
            plan.rows.push(row);
            row += plan.grids[grid].times.len();
        }
        plan.rows.push(row);
        plan.members = Grouped::new(&group_of, plan.groups.len());
        plan
    }

    /// The number of a grid that is added.
    fn add_grid(&mut self, prior: &Arrival, quadrature: &Quadrature, distance: f64, extent: f64) -> usize {
        self.horizons.push(prior.is_horizon());
        self.possible.push(false);
        self.grids.push(prior.grid(quadrature, distance, extent));
        self.grids.len() - 1
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

fn distance(one: &[f64], other: &[f64]) -> f64 {
    one.iter().zip(other).map(|(a, y)| (a - y) * (a - y)).sum::<f64>().sqrt()
}
