//! Liang, Ahmad, Gan, Langdon, Hardy and Godsill, "On Destination Prediction Based on Markov Bridging Distributions".

mod complexity;
pub mod pointing;
mod prediction_error;
pub mod vessels;

use crate::Effort;
use crate::report::Chapter;
use presentation::ProgressBar;

pub fn work(effort: Effort) -> u64 {
    vessels::work(effort) + complexity::work(effort) + pointing::work(effort)
}

pub fn chapter(effort: Effort, progress: &ProgressBar) -> Chapter {
    let mut exhibits = vessels::exhibits(effort, progress);
    exhibits.extend(complexity::exhibits(effort, progress));
    exhibits.extend(pointing::exhibits(effort, progress));
    Chapter {
        citation: "J. Liang, B. I. Ahmad, R. Gan, P. Langdon, R. Hardy and S. Godsill, On Destination Prediction Based on Markov Bridging Distributions, IEEE Signal Processing Letters, 2019",
        exhibits,
    }
}
