//! Filtering, prediction and smoothing: Rezaie and Li (12), with every pinned state that is still ahead.
//!
//! The augmented state is `[x_k; the pinned states after k]`. It begins as the joint density of all pinned states, moves by
//! the sequence's model, is corrected by measurements of `x_k`, and loses a block as each pin is reached: there `x_k` is the
//! pinned state, whose density is known already. Any number of steps is skipped in one go.

use super::model::{Model, StepModel};
use crate::error::Result;
use crate::math::gaussian::{Gaussian, condition, symmetrise};
use crate::math::kalman::Measurement;
use nalgebra::{DMatrix, DVector};

/// The density of the state now and of the pinned states ahead, given the measurements so far.
#[derive(Clone, Debug)]
pub(super) struct Filter {
    /// The step that the filter has come to.
    pub step: usize,
    /// Blocks of `s`: the state now, the pinned states ahead, and whatever is carried along.
    joint: Gaussian,
    /// How many pinned states are ahead.
    ahead: usize,
}

impl Filter {
    /// At step 0, before any measurement.
    pub fn new(model: &Model) -> Self {
        Self { step: 0, joint: model.pinned.clone(), ahead: model.pins.len() - 1 }
    }

    /// Moves on to `step`, not before the filter's own.
    pub fn advance(&mut self, model: &Model, step: usize) -> Result<()> {
        let s = model.states;
        while self.step < step {
            let pin = model.next_pin(self.step);
            if step < pin {
                self.move_by(&model.between(self.step, step)?);
                self.step = step;
            } else {
                // x_k is the pinned state from here on
                let size = self.joint.mean.len() - s;
                self.joint = Gaussian {
                    mean: self.joint.mean.rows(s, size).into_owned(),
                    covariance: self.joint.covariance.view((s, s), (size, size)).into_owned(),
                };
                self.ahead -= 1;
                self.step = pin;
            }
        }
        Ok(())
    }

    /// One application of (12): only the first block moves.
    fn move_by(&mut self, model: &StepModel) {
        let s = model.offset.len();
        let p = &mut self.joint.covariance;
        let size = p.nrows();
        let block = |first: usize| p.rows(first, s).into_owned();
        let mut rows = &model.previous * block(0) + &model.destination * block(s);
        let mut now = rows.columns(0, s) * model.previous.transpose()
            + rows.columns(s, s) * model.destination.transpose()
            + &model.covariance;
        symmetrise(&mut now);
        rows.columns_mut(0, s).copy_from(&now);
        p.rows_mut(0, s).copy_from(&rows);
        p.view_mut((s, 0), (size - s, s)).tr_copy_from(&rows.columns(s, size - s));
        let mean = &mut self.joint.mean;
        let block = |first: usize| mean.rows(first, s).into_owned();
        let moved = &model.previous * block(0) + &model.destination * block(s) + &model.offset;
        mean.rows_mut(0, s).copy_from(&moved);
    }

    /// Corrects with a measurement of the state now.
    pub fn correct(&mut self, measurement: &Measurement) {
        let (rows, s) = measurement.matrix.shape();
        let mut matrix = DMatrix::zeros(rows, self.joint.mean.len());
        matrix.columns_mut(0, s).copy_from(&measurement.matrix);
        // the noise is positive definite, so the prediction error's covariance is
        if let Some(conditioning) = condition(&self.joint.covariance, &matrix, &measurement.noise) {
            let error = &measurement.value - &matrix * &self.joint.mean;
            self.joint.mean += &conditioning.gain * &error;
            self.joint.covariance = conditioning.covariance();
        }
    }

    /// From here on the state now is carried along as the last block, so that later measurements smooth it.
    fn carry(&mut self, states: usize) {
        let size = self.joint.mean.len();
        let source = |i: usize| if i < size { i } else { i - size };
        let Gaussian { mean, covariance } = &self.joint;
        self.joint = Gaussian {
            mean: DVector::from_fn(size + states, |i, _| mean[source(i)]),
            covariance: DMatrix::from_fn(size + states, size + states, |i, j| covariance[(source(i), source(j))]),
        };
    }

    fn block(&self, model: &Model, index: usize) -> Gaussian {
        let s = model.states;
        Gaussian {
            mean: self.joint.mean.rows(index * s, s).into_owned(),
            covariance: self.joint.covariance.view((index * s, index * s), (s, s)).into_owned(),
        }
    }

    /// The state now.
    pub fn state(&self, model: &Model) -> Gaussian {
        self.block(model, 0)
    }

    /// The state at the end.
    pub fn destination(&self, model: &Model) -> Gaussian {
        self.block(model, self.ahead)
    }
}

/// The state at `step` given all `measurements` (each with its step, ascending), some of them later: a fixed-point smoother.
pub(super) fn smoothed(model: &Model, measurements: &[(usize, Measurement)], step: usize) -> Result<Gaussian> {
    let mut filter = Filter::new(model);
    let (before, after) = measurements.split_at(measurements.partition_point(|(at, _)| *at <= step));
    for (at, measurement) in before {
        filter.advance(model, *at)?;
        filter.correct(measurement);
    }
    filter.advance(model, step)?;
    filter.carry(model.states);
    for (at, measurement) in after {
        filter.advance(model, *at)?;
        filter.correct(measurement);
    }
    Ok(filter.block(model, filter.ahead + 1))
}
