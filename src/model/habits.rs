//! Priors that are learnt from what was chosen: counts with a Dirichlet prior, a rate of forgetting, and counts of their own
//! after each last choice.
//!
//! With `a_i` the shares of the scenario's priors, `n_i` the counts and `m_ij` the counts after the choice `j` before,
//! ```text
//! p(i)          = (strength a_i + n_i) / (strength + sum n)
//! p(i | last j) = (afterLast p(i) + m_ij) / (afterLast + sum_i m_ij)
//! ```
//! At every choice all counts shrink by the share `forgetting` before the new one is added, so that a habit that ended
//! fades. What an application really knows better than any model of the hand is what its user usually chooses next.

use super::destination::Destinations;
use crate::error::{Code, Result};
use crate::math::radix_sort::sort_numbers;
use crate::value::{Node, Path, Value};

/// Counts below this are forgotten.
const LEAST_COUNT: f64 = 1e-6;

/// More pairs of last and next choice than this are not kept: the rarest half goes.
const MOST_PAIRS: usize = 1 << 16;

/// How a predictor learns from what is chosen: the destinations' priors, by counts with a Dirichlet prior. With the method `pointing` it also
/// learns how far the model holds for the user, [`Learnt`](crate::Learnt), which alone remains where the strength is as large as 1e50; other
/// methods learn priors alone.
///
/// ```
/// use whither::Learning;
/// // the scenario's priors are worth five choices, the habit at large three after each last choice; a fiftieth is forgotten each time
/// let learning = Learning::new(5.0).forgetting(0.02).after_last(3.0);
/// # let _ = learning;
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct Learning {
    /// How many choices the scenario's priors are worth.
    strength: f64,
    /// Share of every count that is lost at each choice.
    forgetting: f64,
    /// How many choices the habit at large is worth against the habit after the last choice; none: the last choice is not
    /// regarded.
    after_last: Option<f64>,
}

/// What was chosen so far.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Habits {
    /// Under an empty `last`.
    counts: Counts,
    pairs: Counts,
    last: Option<String>,
}

/// Counts in the order of their keys, in one flat list: found by bisection.
#[derive(Clone, Debug, Default, PartialEq)]
struct Counts(Vec<Count>);

#[derive(Clone, Debug, PartialEq)]
struct Count {
    last: String,
    id: String,
    count: f64,
}

impl Counts {
    fn find(&self, last: &str, id: &str) -> std::result::Result<usize, usize> {
        self.0.binary_search_by(|entry| (entry.last.as_str(), entry.id.as_str()).cmp(&(last, id)))
    }

    fn get(&self, last: &str, id: &str) -> f64 {
        self.find(last, id).map_or(0.0, |place| self.0[place].count)
    }

    /// The count of a key, which begins at zero.
    fn entry(&mut self, last: &str, id: &str) -> &mut f64 {
        let place = self.find(last, id).unwrap_or_else(|place| {
            self.0.insert(place, Count { last: last.to_owned(), id: id.to_owned(), count: 0.0 });
            place
        });
        &mut self.0[place].count
    }

    fn shrink(&mut self, keep: f64) {
        self.0.retain_mut(|entry| {
            entry.count *= keep;
            entry.count >= LEAST_COUNT
        });
    }
}

impl Learning {
    /// Priors of the scenario that are worth `strength` choices, above 0; nothing is forgotten, and the last choice has no influence.
    #[must_use]
    pub const fn new(strength: f64) -> Self {
        Self { strength, forgetting: 0.0, after_last: None }
    }

    /// The share of every count that is lost at each choice, at least 0 and less than 1.
    #[must_use]
    pub const fn forgetting(self, share: f64) -> Self {
        Self { forgetting: share, ..self }
    }

    /// Counts what is chosen after each last choice; the habit at large is worth so many choices against that, above 0.
    #[must_use]
    pub const fn after_last(self, strength: f64) -> Self {
        Self { after_last: Some(strength), ..self }
    }

    /// Reads `{ strength, forgetting?, afterLast? }`.
    pub(crate) fn read(node: &Node<'_>) -> Result<Self> {
        let fields = node.fields(&["strength", "forgetting", "afterLast"])?;
        Ok(Self {
            strength: fields.float("strength")?,
            forgetting: fields.optional("forgetting").map_or(Ok(0.0), |share| share.float())?,
            after_last: fields.optional("afterLast").map(|strength| strength.float()).transpose()?,
        })
    }

    /// Whether these numbers are legal.
    ///
    /// # Errors
    /// `not-finite`, `out-of-range`.
    pub(crate) fn check(&self, at: &Path<'_>) -> Result<()> {
        let place = at.key("forgetting");
        if !(0.0..1.0).contains(&place.number(self.forgetting)?) {
            return Err(place.error(Code::OutOfRange, "must be at least 0 and less than 1", self.forgetting));
        }
        at.key("strength").positive(self.strength)?;
        self.after_last.map_or(Ok(()), |strength| at.key("afterLast").positive(strength).map(|_| ()))
    }

    /// The key as it is written.
    #[must_use]
    pub(crate) fn to_value(&self) -> Value {
        Value::map([
            ("strength", Value::Number(self.strength)),
            ("forgetting", Value::Number(self.forgetting)),
            ("afterLast", self.after_last.map_or(Value::Null, Value::Number)),
        ])
    }
}

impl Habits {
    /// Counts a choice.
    pub fn chosen(&mut self, learning: &Learning, id: &str) {
        let keep = 1.0 - learning.forgetting;
        self.counts.shrink(keep);
        self.pairs.shrink(keep);
        *self.counts.entry("", id) += 1.0;
        if let Some(last) = self.last.replace(id.to_owned())
            && learning.after_last.is_some()
        {
            *self.pairs.entry(&last, id) += 1.0;
            let pairs = &mut self.pairs.0;
            if pairs.len() > MOST_PAIRS {
                let mut counts: Vec<f64> = pairs.iter().map(|pair| pair.count).collect();
                sort_numbers(&mut counts);
                let middle = counts[counts.len() / 2];
                let mut surplus = counts.len() / 2;
                pairs.retain(|pair| {
                    let goes = pair.count <= middle && surplus > 0;
                    surplus -= usize::from(goes);
                    !goes
                });
            }
        }
    }

    /// The priors of `destinations` as they are learnt; destinations that the scenario rules out stay ruled out.
    #[must_use]
    pub fn priors(&self, learning: &Learning, destinations: &Destinations) -> Vec<f64> {
        let given: Vec<f64> = destinations.given_priors().collect();
        let total: f64 = given.iter().sum();
        let possible = |i: usize, count: f64| if given[i] > 0.0 { count } else { 0.0 };
        let mut at_large: Vec<f64> = destinations
            .ids()
            .enumerate()
            .map(|(i, id)| learning.strength * given[i] / total + possible(i, self.counts.get("", id)))
            .collect();
        normalise(&mut at_large);
        let (Some(weight), Some(last)) = (learning.after_last, &self.last) else { return at_large };
        let mut after: Vec<f64> = Vec::with_capacity(at_large.len());
        for (i, (id, share)) in destinations.ids().zip(&at_large).enumerate() {
            after.push(weight * share + possible(i, self.pairs.get(last, id)));
        }
        normalise(&mut after);
        after
    }

    /// What a snapshot keeps.
    #[must_use]
    pub fn save(&self) -> Value {
        let save = |counts: &Counts, skipped: usize| {
            let parts =
                |entry: &Count| vec![Value::text(&entry.last), Value::text(&entry.id), Value::exact(entry.count)];
            Value::List(counts.0.iter().map(|entry| Value::List(parts(entry).split_off(skipped))).collect())
        };
        Value::map([
            ("counts", save(&self.counts, 1)),
            ("pairs", save(&self.pairs, 0)),
            ("last", self.last.as_deref().map_or(Value::Null, Value::text)),
        ])
    }

    /// The habits that [`Habits::save`] wrote.
    ///
    /// # Errors
    /// Those of reading a value.
    pub fn load(node: &Node<'_>) -> Result<Self> {
        let fields = node.fields(&["counts", "pairs", "last"])?;
        let mut habits = Self::default();
        for item in fields.required("counts")?.items()? {
            let parts: Vec<Node<'_>> = item.items()?.collect();
            let [id, count] = parts.as_slice() else { return Err(item.error(Code::WrongLength, "must have 2 items")) };
            *habits.counts.entry("", id.text()?) = count.exact()?;
        }
        for item in fields.required("pairs")?.items()? {
            let parts: Vec<Node<'_>> = item.items()?.collect();
            let [last, id, count] = parts.as_slice() else {
                return Err(item.error(Code::WrongLength, "must have 3 items"));
            };
            *habits.pairs.entry(last.text()?, id.text()?) = count.exact()?;
        }
        habits.last = fields.optional("last").map(|last| last.text().map(str::to_owned)).transpose()?;
        Ok(habits)
    }
}

fn normalise(weights: &mut [f64]) {
    let total: f64 = weights.iter().sum();
    weights.iter_mut().for_each(|weight| *weight /= total);
}
