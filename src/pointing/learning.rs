//! What a movement teaches about its user once its target is known ([`crate::model::learnt`]): the states that it kept are evaluated
//! again, all targets at once.

use super::trail::{Approach, Trail};
use super::{Pointing, Space};
use crate::model::learnt::{Learnt, Lesson};

/// At most so many samples of a movement are learnt from, evenly spaced.
const SAMPLES: usize = 8;

impl<S: Space> Pointing<S> {
    /// From now on this holds of the user.
    pub fn apply(&mut self, learnt: &Learnt) {
        self.learnt = *learnt;
        self.from_start.forget();
    }

    /// The movement keeps from here on what [`Pointing::learn`] needs.
    pub fn keep_trail(&mut self) {
        self.trail = Some(Box::new(Trail::new()));
    }

    /// Learns that the movement goes to the target `chosen`, once: what it kept is given away. Nothing is learnt from a movement that
    /// never was outside of the target, nor from one to a target whose prior rules it out.
    pub fn learn(&mut self, chosen: usize, learnt: &mut Learnt) {
        let Some(trail) = self.trail.take() else { return };
        let (now, d) = (self.course.moment(), self.course.dimensions());
        let approach = trail.approach(now, &self.targets.center(chosen), self.targets.extent(chosen), d);
        if let Some(approach) = approach
            && self.targets.priors()[chosen] > 0.0
        {
            learnt.take(&self.lesson(chosen, &approach));
        }
        self.course.recall(&now);
        self.nodes.refresh(&self.parameters, &self.course);
        self.apply(learnt);
    }

    /// What an approach teaches. The course and the nodes stay at the last sample.
    fn lesson(&mut self, chosen: usize, approach: &Approach) -> Lesson {
        let mut lesson = Lesson { samples: approach.samples, ..Lesson::default() };
        let (mut weights, mut shares) = (Vec::new(), Vec::new());
        for moment in approach.moments.iter().step_by(approach.moments.len().div_ceil(SAMPLES).max(1)) {
            self.course.recall(moment);
            self.nodes.refresh(&self.parameters, &self.course);
            let Some(found) = self.weights(&mut weights) else { continue };
            let (mut mean, mut square, mut of_chosen) = (0.0, 0.0, 0.0);
            let (kept, possible) = (1.0 - self.parameters.uniform, self.from_start.possible as f64);
            shares.clear();
            for (i, weight) in weights.iter().enumerate() {
                let share = weight / found.total;
                let score = share.max(f64::MIN_POSITIVE).ln();
                mean += share * score;
                square += share * score * score;
                if i == chosen {
                    of_chosen = score;
                }
                shares.push((i, kept * share + self.parameters.uniform / possible));
            }
            lesson.used += 1.0;
            lesson.excess += mean - of_chosen;
            lesson.variance += square - mean * mean;
            let left = approach.entry - moment.elapsed();
            if left > 0.0
                && let Some(times) = self.entry_time(&shares)
            {
                lesson.timed += 1.0;
                lesson.later.iter_mut().zip(times).for_each(|(later, time)| *later += f64::from(u8::from(left > time)));
            }
        }
        lesson
    }
}
