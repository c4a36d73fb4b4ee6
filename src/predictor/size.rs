//! How many numbers a predictor holds: the package reserves memory for them before a call (`js/core/memory.ts`).

use super::Predictor;
use crate::likelihood::Method;
use crate::scenario::Setup;

impl Predictor {
    /// Destinations, and bytes of their ids; and of the papers' methods numbers for each destination and arrival time, numbers for
    /// each arrival time of a class of destinations, those that a movement keeps, those that a snapshot has.
    pub(crate) fn sizes(&self) -> [f64; 6] {
        let [pairs, nodes, kept, saved] = self.numbers();
        [self.len() as f64, self.destinations.ids_length() as f64, pairs, nodes, kept, saved]
    }

    fn numbers(&self) -> [f64; 4] {
        let (scenario, destinations) = (&self.scenario, &self.destinations);
        let Setup::Papers { method, arrival, quadrature, .. } = &scenario.setup else { return [0.0; 4] };
        let (mut pairs, mut nodes) = (0, 0);
        for (class, count) in destinations.classes().iter().zip(destinations.class_sizes()) {
            let prior = class.arrival().unwrap_or(arrival);
            let points = prior.points(quadrature);
            pairs += count * points;
            nodes += points + if prior.needs_distance() { count * points } else { 0 };
        }
        let candidates = scenario.motion.candidates.len() as f64;
        let states = scenario.motion.states() as f64;
        let (pairs, nodes) = (pairs as f64 * candidates, nodes as f64 * candidates);
        let apart = scenario.motion.depends_on_destination();
        let columns = if apart { 2.0 * states * destinations.len() as f64 * candidates } else { 0.0 };
        let table = match method {
            // of a filter of the state and the endpoint
            Method::Bridging => (2.0 * states + 1.0) * pairs + 4.0 * states * states * nodes,
            Method::PseudoObservation if !apart => 0.0,
            _ => pairs,
        };
        let saved = columns + if method.accumulates() { table } else { 0.0 };
        [pairs, nodes, table + columns, saved]
    }
}
