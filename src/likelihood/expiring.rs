//! Arrival times pass. Once all have, the probabilities stay as they last were, and the filters go on.

use crate::error::Result;
use crate::value::{Node, Value};

/// Filters now, and as they were before every arrival node had passed.
#[derive(Clone, Debug)]
pub(crate) struct Expiring<F> {
    /// After the latest observation.
    pub now: F,
    /// After the last observation at which a node was left; none as long as one is.
    before: Option<Box<F>>,
}

impl<F: Clone> Expiring<F> {
    /// Filters with a node left.
    pub const fn new(now: F) -> Self {
        Self { now, before: None }
    }

    /// Whether every node has passed.
    pub const fn expired(&self) -> bool {
        self.before.is_some()
    }

    /// The filters whose likelihoods hold.
    pub fn evidence(&self) -> &F {
        self.before.as_deref().unwrap_or(&self.now)
    }

    /// The same, to compute with.
    pub fn evidence_mut(&mut self) -> &mut F {
        self.before.as_deref_mut().unwrap_or(&mut self.now)
    }

    /// Takes in an observation, after which there is a node left or not.
    ///
    /// # Errors
    /// Those of `advance`, which has changed nothing then.
    pub fn advance(&mut self, is_alive: bool, advance: impl FnOnce(&mut F) -> Result<()>) -> Result<()> {
        let before = (!self.expired() && !is_alive).then(|| Box::new(self.now.clone()));
        advance(&mut self.now)?;
        if before.is_some() {
            self.before = before;
        }
        Ok(())
    }

    /// Other destinations, of which `is_alive` is whether there is a node left.
    pub fn replan(&mut self, replan: impl Fn(&mut F), is_alive: impl FnOnce(&F) -> bool) {
        replan(&mut self.now);
        self.before = match self.before.take() {
            _ if is_alive(&self.now) => None,
            Some(mut before) => {
                replan(&mut before);
                Some(before)
            }
            None => Some(Box::new(self.now.clone())),
        };
    }

    /// Both in another form.
    pub fn map<G>(&self, form: impl Fn(&F) -> Option<G>) -> Option<Expiring<G>> {
        Some(Expiring { now: form(&self.now)?, before: self.before.as_deref().and_then(&form).map(Box::new) })
    }

    /// What a snapshot keeps.
    pub fn save(&self, save: impl Fn(&F) -> Value) -> Value {
        let before = self.before.as_deref().map_or(Value::Null, &save);
        Value::map([("now", save(&self.now)), ("before", before)])
    }

    /// What [`Expiring::save`] wrote.
    ///
    /// # Errors
    /// Those of `load`.
    pub fn load(node: &Node<'_>, load: impl Fn(&Node<'_>) -> Result<F>) -> Result<Self> {
        let fields = node.fields(&["now", "before"])?;
        let before = fields.optional("before").map(|before| load(&before).map(Box::new)).transpose()?;
        Ok(Self { now: load(&fields.required("now")?)?, before })
    }
}
