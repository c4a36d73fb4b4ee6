//! The charts: accuracy over the course of the movement, and calibration.

use crate::report::{Results, Set};
use presentation::{COLOURS, Corner, Panel, Series, Stroke, chart, write};
use std::path::Path;
use whither::study::metrics::COURSE;

/// Writes one SVG for each set into `folder` and returns their names.
pub fn write_all(results: &Results, folder: &Path) -> Result<Vec<String>, String> {
    let mut names = Vec::new();
    for set in &results.sets {
        let path = folder.join(set.name.replace(' ', "_")).with_extension("svg");
        write(&path, &draw(set))?;
        names.push(path.display().to_string());
    }
    Ok(names)
}

fn draw(set: &Set) -> String {
    let diagonal = Series::new("", COLOURS[6], [(0.0, 0.0), (1.0, 1.0)]).thin(0.4);
    let (mut accuracy, mut calibration) = (Vec::new(), vec![diagonal]);
    for ((name, row), colour) in set.shown().into_iter().zip(COLOURS.into_iter().cycle()) {
        let total = row.total();
        let points = total.course.iter().enumerate();
        let points = points.map(|(k, right)| (100.0 * k as f64 / (COURSE - 1) as f64, 100.0 * right / total.tracks));
        accuracy.push(Series::new("", colour, points));
        let filled = total.bins.iter().filter(|bin| bin.count > 0.0);
        let points: Vec<_> = filled.map(|bin| (bin.predicted / bin.count, bin.happened / bin.count)).collect();
        // the legend of both panels: below the diagonal is room
        calibration.push(Series::new(name, colour, points.iter().copied()));
        calibration.push(Series::new("", colour, points).stroke(Stroke::Dots));
    }
    let panels = [
        Panel {
            title: format!("{}: right, on the way to the target", set.name),
            x: ("% of the time", 0.0..100.0),
            y: ("% of the movements", 0.0..100.0),
            legend: Some(Corner::LowerRight),
            series: accuracy,
        },
        Panel {
            title: "calibration of the top probability".to_owned(),
            x: ("predicted", 0.0..1.0),
            y: ("happened", 0.0..1.0),
            legend: Some(Corner::LowerRight),
            series: calibration,
        },
    ];
    chart(&panels, 2, (560, 480))
}
