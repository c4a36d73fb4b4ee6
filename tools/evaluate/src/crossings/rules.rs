//! Rules for when a target is meant, beside one threshold for all, each with as many wrong crossings as that.

use super::course::{Course, Moment};

/// Thresholds that rules are tried with: odds of 4, which are a probability of .8, times `e^(k/20)`, `k` from -60 to 60.
pub const STEPS: usize = 121;

/// The place of .8 among them.
pub const PLAIN: usize = 60;

/// A rule: what it asks for is a threshold, and of a target whatever it says here.
#[derive(Clone, Copy, Debug)]
pub enum Rule {
    /// One threshold for all targets.
    Plain,
    /// To have been above the threshold for so many seconds.
    Held(f64),
    /// That the cosine between the movement and the way to it is at least this.
    Ahead(f64),
    /// That the movement did not begin on it, or has left it and turned back.
    NotLeaving,
    /// That the pointer is not over it.
    NotOver,
    /// That the speed is at most this share of the highest so far.
    Slower(f64),
    /// Odds that rise with the distance to this power.
    Far(f64),
    /// The rule of `whither/dom`: such odds, and ahead.
    FarAhead(f64),
}

/// The rows of the table.
pub const ALL: [Rule; 13] = [
    Rule::Plain,
    Rule::NotLeaving,
    Rule::NotOver,
    Rule::Held(0.03),
    Rule::Held(0.1),
    Rule::Slower(0.8),
    Rule::Ahead(0.0),
    Rule::Ahead(0.5),
    Rule::Far(0.3),
    Rule::Far(0.6),
    Rule::Far(1.0),
    Rule::FarAhead(0.6),
    Rule::FarAhead(1.0),
];

impl Rule {
    /// As the table calls it.
    pub fn name(self) -> String {
        match self {
            Self::Plain => "one threshold".to_owned(),
            Self::Held(seconds) => format!("held for {} ms", 1000.0 * seconds),
            Self::Ahead(cosine) => format!("ahead: cosine at least {cosine}"),
            Self::NotLeaving => "not what it began on".to_owned(),
            Self::NotOver => "not what the pointer is over".to_owned(),
            Self::Slower(share) => format!("slower than {share} of the peak"),
            Self::Far(power) => format!("more while far, power {power}"),
            Self::FarAhead(power) => format!("more while far, power {power}, and ahead"),
        }
    }

    /// The log odds of a target as the threshold is compared with; none where it is not to be meant.
    fn log_odds(self, speed: f64, moment: &Moment) -> Option<f64> {
        let log_odds = (moment.probability / (1.0 - moment.probability)).ln();
        // as `js/dom/prediction/demand.ts` has it
        let far = |power: f64| log_odds - power * ((moment.distance + 10.0) / 60.0).ln();
        match self {
            Self::Plain | Self::Held(_) => Some(log_odds),
            Self::Ahead(cosine) => (moment.ahead >= cosine).then_some(log_odds),
            Self::NotLeaving => (!moment.leaving).then_some(log_odds),
            Self::NotOver => (!moment.over).then_some(log_odds),
            Self::Slower(share) => (speed <= share).then_some(log_odds),
            Self::Far(power) => Some(far(power)),
            Self::FarAhead(power) => (moment.ahead >= 0.0).then(|| far(power)),
        }
    }
}

/// What a rule led to with one of the thresholds, summed over movements; a target is meant once a movement.
#[derive(Clone, Copy, Debug, Default)]
pub struct Counts {
    /// Crossings before the press for others than the true target.
    pub wrong: f64,
    /// Movements whose true target is meant before the entry, and those in which it is the first of all.
    pub early: f64,
    pub right: f64,
    /// Seconds from then to the entry.
    pub lead: f64,
}

impl Counts {
    pub fn add(&mut self, other: &Self) {
        self.wrong += other.wrong;
        self.early += other.early;
        self.right += other.right;
        self.lead += other.lead;
    }
}

/// What a rule leads to with each of the thresholds on one movement.
pub fn run(rule: Rule, course: &Course) -> [Counts; STEPS] {
    let mut counts = [Counts::default(); STEPS];
    // which threshold a target is above: one more than the place of the highest, 0 for none
    let level = |log_odds: f64| ((log_odds - 4f64.ln()) * 20.0 + PLAIN as f64).floor() + 1.0;
    let mut reached = vec![0; course.moments[0].len()];
    let mut taken = [false; STEPS];
    for (k, moments) in course.moments.iter().enumerate().take(course.press) {
        for (i, moment) in moments.iter().enumerate() {
            let now = |k: usize, moment: &Moment| rule.log_odds(course.speeds[k], moment).map_or(0.0, level);
            let above = if let Rule::Held(seconds) = rule {
                held(course, k, seconds, |k| now(k, &course.moments[k][i]))
            } else {
                now(k, moment)
            };
            let above = above.clamp(0.0, STEPS as f64) as usize;
            for (counts, taken) in counts.iter_mut().zip(&mut taken).take(above).skip(reached[i]) {
                if i != course.target {
                    counts.wrong += 1.0;
                } else if k < course.entry {
                    counts.early = 1.0;
                    counts.right = f64::from(u8::from(!*taken));
                    counts.lead = course.leads(k)[0];
                }
                *taken = true;
            }
            reached[i] = reached[i].max(above);
        }
    }
    counts
}

/// The least of the levels in so many seconds until a sample; 0 where the movement is not as old.
fn held(course: &Course, k: usize, seconds: f64, level: impl Fn(usize) -> f64) -> f64 {
    let since = course.times[k] - seconds + 1e-9;
    if course.times[0] > since {
        return 0.0;
    }
    // from the last sample before
    let from = course.times.partition_point(|&time| time <= since).saturating_sub(1);
    (from..=k).map(level).fold(f64::INFINITY, f64::min)
}

#[cfg(test)]
mod tests {
    use super::super::course::tests::course;
    use super::*;

    /// Two samples on the first target, three on the wrong one that is on the path, the rest on the true one.
    fn crossing() -> Course {
        let [origin, path, truth] = [[0.85, 0.05, 0.05, 0.05], [0.05, 0.85, 0.05, 0.05], [0.02, 0.02, 0.95, 0.01]];
        course(&[origin, origin, path, path, truth, truth, truth, truth])
    }

    /// Wrong, early, right, lead at a threshold of .8.
    fn at_plain(rule: Rule) -> [f64; 4] {
        let Counts { wrong, early, right, lead } = run(rule, &crossing())[PLAIN];
        [wrong, early, right, (10.0 * lead).round() / 10.0]
    }

    #[test]
    fn each_rule_leaves_out_what_it_says() {
        assert_eq!(at_plain(Rule::Plain), [2.0, 1.0, 0.0, 0.2]);
        assert_eq!(at_plain(Rule::NotLeaving), [1.0, 1.0, 0.0, 0.2]);
        // the origin is left out while it is left, the one on the path where the pointer has passed it
        assert_eq!(at_plain(Rule::Ahead(0.0))[0], 1.0);
        // on its first visit the pointer is over the true one
        assert_eq!(at_plain(Rule::NotOver), [2.0, 1.0, 0.0, 0.1]);
        assert_eq!(at_plain(Rule::Slower(0.8))[3], 0.1);
        // the origin was above for .1 s, the one on the path too; the true one only from the sample after on
        assert_eq!(at_plain(Rule::Held(0.1)), [2.0, 1.0, 0.0, 0.1]);
        assert_eq!(at_plain(Rule::Held(0.15)), [0.0, 0.0, 0.0, 0.0]);
    }

    #[test]
    fn odds_rise_with_the_distance() {
        let moment = Moment { probability: 0.8, distance: 50.0, ahead: 1.0, over: false, leaving: false };
        let odds = |rule: Rule, moment: &Moment| rule.log_odds(1.0, moment).map(|x| (100.0 * x.exp()).round() / 100.0);
        assert_eq!(odds(Rule::Far(0.6), &moment), Some(4.0));
        // 4 / (560/60)^.6, 4 / (10/60)^.6
        assert_eq!(odds(Rule::Far(0.6), &Moment { distance: 550.0, ..moment }), Some(1.05));
        assert_eq!(odds(Rule::FarAhead(0.6), &Moment { distance: 0.0, ..moment }), Some(11.72));
        assert_eq!(odds(Rule::FarAhead(0.6), &Moment { ahead: -0.1, ..moment }), None);
    }

    #[test]
    fn a_lower_threshold_is_crossed_by_whatever_crosses_a_higher_one() {
        for rule in ALL {
            let counts = run(rule, &crossing());
            for pair in counts.windows(2) {
                assert!(pair[0].wrong >= pair[1].wrong && pair[0].early >= pair[1].early, "{rule:?}");
            }
        }
    }
}
