//! The first crossing: which target is the first above a threshold, how early, and how often there is another, on the posteriors of
//! the file's scenario. What `whither/dom` makes of them on a page is replayed by `--intents`.

mod course;
mod rules;

use crate::methods::Template;
use course::{Course, Place};
use presentation::table;
use rules::{Counts, PLAIN, STEPS};
use serde_json::{Value as Json, json};
use std::collections::BTreeMap;
use whither::study::simulate::Random;
use whither::study::track::Track;

/// Thresholds of the first table.
const THRESHOLDS: [f64; 8] = [0.5, 0.6, 0.7, 0.8, 0.85, 0.9, 0.95, 0.98];

/// A target is meant until its probability is below this share of the threshold.
const RELEASES: [f64; 3] = [1.0, 0.625, 0.25];

/// The threshold of the second table, and seconds of rest.
const USUAL: f64 = 0.8;
const REST: f64 = 1.0;

/// How often users are drawn for an interval.
const DRAWS: usize = 1000;

/// The results of all sets: by set and user.
pub type Crossings = BTreeMap<String, BTreeMap<String, Sums>>;

/// The results of some movements.
#[derive(Clone, Debug)]
pub struct Sums {
    movements: f64,
    thresholds: [First; THRESHOLDS.len()],
    /// After a rest where the movement begins, of all targets and without the one it began on.
    rested: [First; 2],
    rules: Vec<[Counts; STEPS]>,
}

/// First crossings of one threshold, summed over movements.
#[derive(Clone, Debug, Default)]
struct First {
    /// Before the entry and of the true target.
    right: f64,
    /// Before the entry and of another, by its place.
    wrong: [f64; Place::NAMES.len()],
    /// Of those right the seconds to the entry and to the press.
    leads: Vec<[f64; 2]>,
    /// For each release, crossings until the press, and those right that are not released before it.
    crossings: [f64; RELEASES.len()],
    held: [f64; RELEASES.len()],
}

impl First {
    /// The first crossing of a movement; `but` is left out.
    fn of(course: &Course, threshold: f64, but: impl Fn(&course::Moment) -> bool) -> Self {
        let mut first = Self::default();
        let probability = |moment: &course::Moment| if but(moment) { 0.0 } else { moment.probability };
        let crossing = course.moments[..course.entry].iter().enumerate().find_map(|(k, moments)| {
            let best =
                (0..moments.len()).max_by(|&a, &b| probability(&moments[a]).total_cmp(&probability(&moments[b])))?;
            (probability(&moments[best]) >= threshold).then_some((k, best))
        });
        let right = crossing.filter(|&(_, target)| target == course.target);
        match crossing {
            Some((k, target)) if target == course.target => {
                first.right = 1.0;
                first.leads.push(course.leads(k));
            }
            Some((_, target)) => first.wrong[course.place(target) as usize] = 1.0,
            None => {}
        }
        for (r, release) in RELEASES.iter().enumerate() {
            let mut meant = vec![false; course.moments[0].len()];
            let mut held = right.is_some();
            for (k, moments) in course.moments.iter().enumerate().take(course.press) {
                for (i, moment) in moments.iter().enumerate() {
                    let now = probability(moment);
                    if !meant[i] && now >= threshold {
                        meant[i] = true;
                        first.crossings[r] += 1.0;
                    } else if meant[i] && now < release * threshold {
                        meant[i] = false;
                        held &= !right.is_some_and(|(crossed, target)| target == i && k > crossed);
                    }
                }
            }
            first.held[r] = f64::from(u8::from(held));
        }
        first
    }

    fn add(&mut self, other: &Self) {
        self.right += other.right;
        add(&mut self.wrong, &other.wrong);
        self.leads.extend(&other.leads);
        add(&mut self.crossings, &other.crossings);
        add(&mut self.held, &other.held);
    }

    fn wrong(&self) -> f64 {
        self.wrong.iter().sum()
    }

    /// The median of the leads, in seconds.
    fn lead(&self, event: usize) -> Option<f64> {
        let mut leads: Vec<f64> = self.leads.iter().map(|leads| leads[event]).collect();
        leads.sort_by(f64::total_cmp);
        let count = leads.len();
        (count > 0).then(|| (leads[(count - 1) / 2] + leads[count / 2]) / 2.0)
    }
}

fn add<const N: usize>(to: &mut [f64; N], from: &[f64; N]) {
    to.iter_mut().zip(from).for_each(|(to, from)| *to += from);
}

impl Default for Sums {
    fn default() -> Self {
        Self {
            movements: 0.0,
            thresholds: std::array::from_fn(|_| First::default()),
            rested: [First::default(), First::default()],
            rules: vec![[Counts::default(); STEPS]; rules::ALL.len()],
        }
    }
}

impl Sums {
    fn of(course: &Course, rested: &Course) -> Self {
        Self {
            movements: 1.0,
            thresholds: THRESHOLDS.map(|threshold| First::of(course, threshold, |_| false)),
            rested: [First::of(rested, USUAL, |_| false), First::of(rested, USUAL, |moment| moment.leaving)],
            rules: rules::ALL.iter().map(|&rule| rules::run(rule, course)).collect(),
        }
    }

    /// Adds other movements.
    pub fn add(&mut self, other: &Self) {
        self.movements += other.movements;
        self.thresholds.iter_mut().zip(&other.thresholds).for_each(|(to, from)| to.add(from));
        self.rested.iter_mut().zip(&other.rested).for_each(|(to, from)| to.add(from));
        for (to, from) in self.rules.iter_mut().zip(&other.rules) {
            to.iter_mut().zip(from).for_each(|(to, from)| to.add(from));
        }
    }
}

/// The results of one movement, only every n-th sample of it; none where it does not come to its target from elsewhere.
pub fn run(template: &Template, track: &Track, every: usize) -> Result<Option<Sums>, String> {
    let of = |rest: f64| Course::of(track, (&template.scenario, &template.extra), every, rest);
    Ok(of(0.0)?.zip(of(REST)?).map(|(course, rested)| Sums::of(&course, &rested)))
}

/// Prints the tables of each set, and returns the same as JSON.
pub fn report(crossings: &Crossings) -> Json {
    println!("\nthe first crossing, on the posteriors (whither/dom: --intents)");
    println!(
        "right, wrong: before the entry and of the true target, of another; else there is none. Leads of those right, medians."
    );
    println!(
        "crossings until the press, and those right that are not released before it: below the threshold / .625 / .25 of it"
    );
    let mut all = serde_json::Map::new();
    for (name, users) in crossings {
        let users: Vec<&Sums> = users.values().collect();
        let mut total = Sums::default();
        users.iter().for_each(|sums| total.add(sums));
        println!("\n{name}: {} movements of {} users", total.movements, users.len());
        let thresholds = print_thresholds(&total, &users);
        let rested = print_rest(&total, &users);
        let rules = print_rules(&total, &users);
        all.insert(name.clone(), json!({ "thresholds": thresholds, "afterRest": rested, "rules": rules }));
    }
    Json::Object(all)
}

fn headings(first: &str) -> Vec<&str> {
    let mut headings = vec![first, "right %", "wrong %"];
    headings.extend(Place::NAMES);
    headings.extend(["none %", "lead to entry, ms", "to press, ms", "crossings", "held %"]);
    headings
}

fn print_thresholds(total: &Sums, users: &[&Sums]) -> Vec<Json> {
    let mut printed = table(headings("threshold"), 1);
    let rows = THRESHOLDS.iter().enumerate().map(|(t, threshold)| {
        let (cells, mut row) = first_row(&format!("{threshold}"), total, users, |sums| &sums.thresholds[t]);
        printed.add_row(cells);
        row["threshold"] = json!(threshold);
        row
    });
    let rows = rows.collect();
    println!("{printed}");
    rows
}

fn print_rest(total: &Sums, users: &[&Sums]) -> Vec<Json> {
    let mut printed = table(headings("threshold .8, a second of rest before"), 1);
    let rows = ["all targets", "but what it began on, until it turns back"].iter().enumerate().map(|(r, name)| {
        let (cells, mut row) = first_row(name, total, users, |sums| &sums.rested[r]);
        printed.add_row(cells);
        row["targets"] = json!(name);
        row
    });
    let rows = rows.collect();
    println!("{printed}");
    rows
}

fn first_row(name: &str, total: &Sums, users: &[&Sums], of: impl Fn(&Sums) -> &First) -> (Vec<String>, Json) {
    let first = of(total);
    let share = |count: f64| 100.0 * count / total.movements;
    let right = interval(users, |sums| [of(sums).right, sums.movements]);
    let wrong = interval(users, |sums| [of(sums).wrong(), sums.movements]);
    let milliseconds =
        |event: usize| first.lead(event).map_or_else(|| "-".to_owned(), |s| format!("{:.0}", 1000.0 * s));
    let crossings = first.crossings.map(|count| count / total.movements);
    let held = first.held.map(|count| 100.0 * count / first.right.max(1.0));
    let triple = |shown: [String; 3]| shown.join(" / ");
    let mut cells = vec![name.to_owned(), ranged(share(first.right), right), ranged(share(first.wrong()), wrong)];
    cells.extend(first.wrong.map(|count| format!("{:.1}", share(count))));
    cells.push(format!("{:.1}", share(total.movements - first.right - first.wrong())));
    cells.extend([milliseconds(0), milliseconds(1)]);
    cells.extend([triple(crossings.map(|x| format!("{x:.2}"))), triple(held.map(|x| format!("{x:.0}")))]);
    let row = json!({
        "right": share(first.right), "rightInterval": right, "wrong": share(first.wrong()), "wrongInterval": wrong,
        "origin": share(first.wrong[0]), "path": share(first.wrong[1]), "elsewhere": share(first.wrong[2]),
        "leadToEntry": first.lead(0), "leadToPress": first.lead(1), "crossings": crossings, "held": held,
    });
    (cells, row)
}

fn print_rules(total: &Sums, users: &[&Sums]) -> Vec<Json> {
    let each = |sum: f64| sum / total.movements;
    let budget = total.rules[0][PLAIN].wrong;
    let headings = ["rule", "threshold", "wrong a movement", "early %", "right %", "mean lead to entry, ms"];
    let mut printed = table(headings, 1);
    let mut rows = Vec::new();
    for (r, rule) in rules::ALL.iter().enumerate() {
        let Some(step) = (0..STEPS).find(|&step| total.rules[r][step].wrong <= budget) else { continue };
        let counts = total.rules[r][step];
        let odds = 4.0 * ((step as f64 - PLAIN as f64) / 20.0).exp();
        let threshold = odds / (1.0 + odds);
        let right = interval(users, |sums| [sums.rules[r][step].right, sums.movements]);
        printed.add_row(vec![
            rule.name(),
            format!("{threshold:.3}"),
            format!("{:.3}", each(counts.wrong)),
            format!("{:.1}", 100.0 * each(counts.early)),
            ranged(100.0 * each(counts.right), right),
            format!("{:.0}", 1000.0 * each(counts.lead)),
        ]);
        rows.push(json!({
            "rule": rule.name(), "threshold": threshold, "wrong": each(counts.wrong), "early": each(counts.early),
            "right": each(counts.right), "rightInterval": right, "lead": each(counts.lead),
        }));
    }
    println!(
        "rules with no more wrong crossings than one threshold of .8, each target once a movement; a movement without has lead 0\n{printed}"
    );
    rows
}

fn ranged(percent: f64, interval: Option<[f64; 2]>) -> String {
    interval.map_or_else(
        || format!("{percent:.1}"),
        |[low, high]| format!("{percent:.1} [{:.1}, {:.1}]", 100.0 * low, 100.0 * high),
    )
}

/// From the 2.5th to the 97.5th percentile of a ratio of sums over users drawn with replacement; none for fewer than two.
fn interval(users: &[&Sums], ratio: impl Fn(&Sums) -> [f64; 2]) -> Option<[f64; 2]> {
    let pairs: Vec<[f64; 2]> = users.iter().map(|sums| ratio(sums)).collect();
    let mut random = Random::new(0);
    let mut drawn: Vec<f64> = (0..DRAWS)
        .map(|_| {
            let mut sum = [0.0; 2];
            pairs.iter().for_each(|_| add(&mut sum, &pairs[(random.uniform() * pairs.len() as f64) as usize]));
            sum[0] / sum[1]
        })
        .collect();
    drawn.sort_by(f64::total_cmp);
    let at = |share: f64| drawn[((DRAWS - 1) as f64 * share).round() as usize];
    (pairs.len() > 1).then(|| [at(0.025), at(0.975)])
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::course::tests::course;
    use super::*;

    const FLAT: [f64; 4] = [0.25; 4];
    const PATH: [f64; 4] = [0.05, 0.85, 0.05, 0.05];
    const TRUE: [f64; 4] = [0.05, 0.05, 0.85, 0.05];

    fn first(probabilities: &[[f64; 4]]) -> First {
        First::of(&course(probabilities), 0.8, |_| false)
    }

    #[test]
    fn the_first_crossing_is_right_wrong_or_none() {
        let right = first(&[FLAT, FLAT, FLAT, TRUE, TRUE, TRUE, TRUE, TRUE]);
        assert_eq!((right.right, right.wrong(), right.crossings, right.held), (1.0, 0.0, [1.0; 3], [1.0; 3]));
        let [entry, press] = right.leads[0];
        assert!((entry - 0.3).abs() < 1e-12 && (press - 0.4).abs() < 1e-12);
        let wrong = first(&[FLAT, PATH, FLAT, TRUE, TRUE, TRUE, TRUE, TRUE]);
        assert_eq!((wrong.right, wrong.wrong, wrong.crossings), (0.0, [0.0, 1.0, 0.0], [2.0; 3]));
        let origin = First::of(&course(&[[0.9, 0.0, 0.1, 0.0]; 8]), 0.8, |_| false);
        assert_eq!(origin.wrong, [1.0, 0.0, 0.0]);
        let left_out = First::of(&course(&[[0.9, 0.0, 0.1, 0.0]; 8]), 0.8, |moment| moment.leaving);
        assert_eq!((left_out.right, left_out.wrong()), (0.0, 0.0));
        // at the entry it is too late
        let late = first(&[FLAT, FLAT, FLAT, FLAT, FLAT, FLAT, TRUE, TRUE]);
        assert_eq!((late.right, late.wrong(), late.crossings), (0.0, 0.0, [1.0; 3]));
    }

    #[test]
    fn a_lower_release_takes_less_back() {
        let between = [0.15, 0.15, 0.55, 0.15];
        let low = [0.3, 0.2, 0.3, 0.2];
        let wavering = first(&[FLAT, FLAT, TRUE, between, TRUE, low, TRUE, TRUE]);
        assert_eq!((wavering.crossings, wavering.held), ([3.0, 2.0, 1.0], [0.0, 0.0, 1.0]));
    }

    #[test]
    fn sums_are_over_movements_and_intervals_over_users() {
        let sums = |probabilities: &[[f64; 4]]| Sums::of(&course(probabilities), &course(probabilities));
        let mut one = sums(&[FLAT, FLAT, FLAT, TRUE, TRUE, TRUE, TRUE, TRUE]);
        one.add(&sums(&[FLAT, PATH, FLAT, TRUE, TRUE, TRUE, TRUE, TRUE]));
        let other = sums(&[FLAT, FLAT, TRUE, TRUE, TRUE, TRUE, TRUE, TRUE]);
        let right = |sums: &Sums| [sums.thresholds[3].right, sums.movements];
        assert_eq!(right(&one), [1.0, 2.0]);
        assert_eq!(interval(&[&one, &other], right), Some([0.5, 1.0]));
        assert_eq!(interval(&[&one], right), None);
        one.add(&other);
        assert!((one.thresholds[3].lead(0).unwrap() - 0.35).abs() < 1e-12);
        assert_eq!(one.rules[0][PLAIN].wrong, 1.0);
    }

    #[test]
    fn a_movement_is_scored_and_reported_by_its_set() {
        let template = Template::pointer().unwrap();
        let track = |target: usize| -> Track {
            let samples: Vec<_> = (0..40).map(|k| json!([0.01 * f64::from(k), 10 * k, 0])).collect();
            let targets = [[0, 0, 30, 30], [380, 0, 30, 30], [0, 300, 30, 30]];
            serde_json::from_value(json!({ "targets": targets, "target": target, "samples": samples })).unwrap()
        };
        assert!(run(&template, &track(2), 1).unwrap().is_none(), "it never comes to its target");
        let mut crossings = Crossings::new();
        let users = crossings.entry("made up".to_owned()).or_default();
        for user in ["ann", "bob"] {
            users.entry(user.to_owned()).or_default().add(&run(&template, &track(1), 1).unwrap().unwrap());
        }
        let reported = report(&crossings);
        let set = &reported["made up"];
        assert_eq!(set["thresholds"][0]["right"], 100.0);
        assert_eq!(set["rules"][0]["rule"], "one threshold");
        assert_eq!(set["afterRest"][0]["origin"], 100.0);
        assert_eq!(set["afterRest"][1]["origin"], 0.0);
    }
}
