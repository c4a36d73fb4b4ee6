//! The charts: accuracy over the course of the movement, and calibration.

use crate::report::{Results, Set};
use plotters::prelude::*;
use std::path::Path;
use whither::study::metrics::COURSE;

/// Colours that people tell apart whatever their colour vision (Okabe and Ito).
const COLOURS: [RGBColor; 8] = [
    RGBColor(0, 114, 178),
    RGBColor(213, 94, 0),
    RGBColor(0, 158, 115),
    RGBColor(204, 121, 167),
    RGBColor(230, 159, 0),
    RGBColor(86, 180, 233),
    RGBColor(0, 0, 0),
    RGBColor(150, 150, 150),
];

/// Writes one SVG for each set into `folder` and returns their names.
pub fn write(results: &Results, folder: &Path) -> Result<Vec<String>, String> {
    std::fs::create_dir_all(folder).map_err(|error| format!("{}: {error}", folder.display()))?;
    let mut names = Vec::new();
    for set in &results.sets {
        let path = folder.join(set.name.replace(' ', "_")).with_extension("svg");
        draw(set, &path).map_err(|error| format!("{}: {error}", path.display()))?;
        names.push(path.display().to_string());
    }
    Ok(names)
}

fn draw(set: &Set, path: &Path) -> Result<(), Box<dyn std::error::Error>> {
    let area = SVGBackend::new(path, (1100, 480)).into_drawing_area();
    area.fill(&WHITE)?;
    let (left, right) = area.split_horizontally(620);
    let (right, legend) = right.split_vertically(320);
    let font = ("sans-serif", 14);
    let shown = set.shown();

    let mut course = ChartBuilder::on(&left)
        .caption(format!("{}: right, on the way to the target", set.name), font)
        .margin(12)
        .x_label_area_size(40)
        .y_label_area_size(48)
        .build_cartesian_2d(0.0..100.0, 0.0..100.0)?;
    course
        .configure_mesh()
        .x_desc("% of the time")
        .y_desc("% of the movements")
        .label_style(font)
        .x_label_formatter(&|x| format!("{x:.0}"))
        .y_label_formatter(&|y| format!("{y:.0}"))
        .max_light_lines(1)
        .draw()?;
    for (line, ((name, row), colour)) in shown.iter().zip(COLOURS.iter().cycle()).enumerate() {
        let total = row.total();
        let points = total.course.iter().enumerate();
        let points = points.map(|(k, right)| (100.0 * k as f64 / (COURSE - 1) as f64, 100.0 * right / total.tracks));
        course.draw_series(LineSeries::new(points, colour.stroke_width(2)))?;
        let height = 18 * line as i32 + 12;
        legend.draw(&PathElement::new([(60, height), (78, height)], colour.stroke_width(2)))?;
        legend.draw(&Text::new(name.clone(), (86, height - 7), font))?;
    }

    let mut calibration = ChartBuilder::on(&right)
        .caption("calibration of the top probability", font)
        .margin(12)
        .x_label_area_size(40)
        .y_label_area_size(48)
        .build_cartesian_2d(0.0..1.0, 0.0..1.0)?;
    calibration.configure_mesh().x_desc("predicted").y_desc("happened").label_style(font).max_light_lines(1).draw()?;
    calibration.draw_series(LineSeries::new([(0.0, 0.0), (1.0, 1.0)], BLACK.mix(0.4)))?;
    for ((_, row), colour) in shown.iter().zip(COLOURS.iter().cycle()) {
        let bins = row.total().bins;
        let filled = bins.iter().filter(|bin| bin.count > 0.0);
        let points: Vec<_> = filled.map(|bin| (bin.predicted / bin.count, bin.happened / bin.count)).collect();
        calibration.draw_series(LineSeries::new(points.clone(), colour.stroke_width(2)))?;
        calibration.draw_series(points.into_iter().map(|point| Circle::new(point, 3, colour.filled())))?;
    }
    area.present()?;
    Ok(())
}
