//! Models whose axes do not mix, which `whither_kernel::axes` filters each on its own.

use crate::model::motion::MotionModel;
use whither_kernel::axes::MOST;
use whither_kernel::mixture::AXES;

/// How many components each axis of a model has, and which move as the first one does; none where its axes mix.
pub fn axes_of_model(model: &dyn MotionModel) -> Option<(usize, [bool; AXES])> {
    let (components, mut alike) = (model.axis(0, 0.0)?.states.min(MOST), [true; AXES]);
    for axis in 0..model.dimensions() {
        // a linear, time-invariant model that is the same over two steps is the same over all
        alike[axis] = [0.37, 1.0].iter().all(|&step| model.axis(axis, step) == model.axis(0, step));
    }
    Some((components, alike))
}
