//! Line charts as SVG.

use plotters::coord::Shift;
use plotters::prelude::*;
use std::ops::Range;

/// Colours that people with any colour vision can distinguish (Okabe and Ito).
pub const COLOURS: [RGBColor; 8] = [
    RGBColor(0, 114, 178),
    RGBColor(213, 94, 0),
    RGBColor(0, 158, 115),
    RGBColor(204, 121, 167),
    RGBColor(230, 159, 0),
    RGBColor(86, 180, 233),
    RGBColor(60, 60, 60),
    RGBColor(150, 150, 150),
];
const INK: RGBColor = RGBColor(29, 33, 41);
const GRID: RGBColor = RGBColor(226, 229, 235);

/// How a line is drawn.
#[derive(Clone, Copy, PartialEq)]
pub enum Stroke {
    Solid,
    Dashed,
    /// A dot at each point.
    Dots,
}

/// A line through points.
pub struct Series {
    /// The text in the legend; one that repeats is shown once, an empty one never.
    pub label: String,
    pub points: Vec<(f64, f64)>,
    pub colour: RGBColor,
    pub stroke: Stroke,
    pub width: f64,
    pub opacity: f64,
}

impl Series {
    pub fn new(label: impl Into<String>, colour: RGBColor, points: impl IntoIterator<Item = (f64, f64)>) -> Self {
        let points = points.into_iter().collect();
        Self { label: label.into(), points, colour, stroke: Stroke::Solid, width: 1.8, opacity: 1.0 }
    }

    pub fn stroke(mut self, stroke: Stroke) -> Self {
        self.stroke = stroke;
        self
    }

    pub fn thin(mut self, opacity: f64) -> Self {
        self.width = 1.0;
        self.opacity = opacity;
        self
    }
}

/// One pair of axes.
pub struct Panel {
    pub title: String,
    pub x: (&'static str, Range<f64>),
    pub y: (&'static str, Range<f64>),
    /// Where a legend is clear of the lines; none where another panel has it.
    pub legend: Option<Corner>,
    pub series: Vec<Series>,
}

/// A corner of a panel.
#[derive(Clone, Copy, Debug)]
pub enum Corner {
    UpperLeft,
    LowerRight,
    MiddleRight,
}

/// Panels side by side, `columns` in a row, as SVG.
pub fn chart(panels: &[Panel], columns: usize, panel_size: (u32, u32)) -> String {
    let rows = panels.len().div_ceil(columns);
    let size = (panel_size.0 * columns as u32, panel_size.1 * rows as u32);
    let mut svg = String::new();
    {
        let root = SVGBackend::with_string(&mut svg, size).into_drawing_area();
        root.fill(&WHITE).expect("a string takes all that is written");
        for (panel, area) in panels.iter().zip(root.split_evenly((rows, columns))) {
            draw(panel, &area).expect("a string takes all that is written");
        }
        root.present().expect("a string takes all that is written");
    }
    svg
}

type Drawn = Result<(), Box<dyn std::error::Error>>;

fn draw(panel: &Panel, area: &DrawingArea<SVGBackend<'_>, Shift>) -> Drawn {
    let text = |size: u32| ("system-ui, sans-serif", size).into_font().color(&INK);
    let mut chart = ChartBuilder::on(area)
        .caption(&panel.title, text(17))
        .margin(8)
        .margin_right(18)
        .x_label_area_size(40)
        .y_label_area_size(56)
        .build_cartesian_2d(panel.x.1.clone(), panel.y.1.clone())?;
    chart
        .configure_mesh()
        .x_desc(panel.x.0)
        .y_desc(panel.y.0)
        .x_labels(8)
        .y_labels(8)
        .label_style(text(13))
        .axis_desc_style(text(14))
        .axis_style(INK)
        .bold_line_style(GRID)
        .light_line_style(TRANSPARENT)
        .x_label_formatter(&|x| label(*x))
        .y_label_formatter(&|y| label(*y))
        .draw()?;
    let mut named: Vec<&str> = Vec::new();
    for series in &panel.series {
        let colour = series.colour.mix(series.opacity);
        let style = ShapeStyle { color: colour, filled: true, stroke_width: series.width.ceil() as u32 };
        let points = series.points.iter().copied();
        let annotation = match series.stroke {
            Stroke::Solid => chart.draw_series(LineSeries::new(points, style))?,
            Stroke::Dashed => chart.draw_series(DashedLineSeries::new(points, 6, 4, style))?,
            Stroke::Dots => chart.draw_series(points.map(|point| Circle::new(point, 2, style)))?,
        };
        if panel.legend.is_some() && !series.label.is_empty() && !named.contains(&series.label.as_str()) {
            named.push(&series.label);
            let stroke = series.stroke;
            let style = ShapeStyle { color: series.colour.mix(1.0), filled: true, stroke_width: 2 };
            annotation.label(series.label.clone()).legend(move |(x, y)| {
                let points: Vec<(i32, i32)> = match stroke {
                    Stroke::Solid => vec![(x, y), (x + 20, y)],
                    Stroke::Dashed => vec![(x, y), (x + 8, y)],
                    Stroke::Dots => vec![(x + 8, y), (x + 12, y)],
                };
                PathElement::new(points, style)
            });
        }
    }
    if let Some(corner) = panel.legend.filter(|_| !named.is_empty()) {
        chart
            .configure_series_labels()
            .position(match corner {
                Corner::UpperLeft => SeriesLabelPosition::UpperLeft,
                Corner::LowerRight => SeriesLabelPosition::LowerRight,
                Corner::MiddleRight => SeriesLabelPosition::MiddleRight,
            })
            .background_style(WHITE.mix(0.85))
            .border_style(GRID)
            .label_font(text(13))
            .margin(6)
            .draw()?;
    }
    Ok(())
}

fn label(x: f64) -> String {
    let rounded = (x * 1e6).round() / 1e6;
    format!("{}", if rounded == 0.0 { 0.0 } else { rounded })
}
