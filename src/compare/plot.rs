//! Residuals over time, drawn: a sheet a body, a panel an axis.

use plotters::coord::Shift;
use plotters::prelude::*;

use super::series::{ResidualSeries, series};
use super::{Axis, Channel, Segment};
use crate::{Reconstruction, Result, Scene};

/// Of Okabe and Ito's colours, told apart by the colour-blind too; shapes tell them as well.
const BEFORE: RGBColor = RGBColor(0, 114, 178);
const AFTER: RGBColor = RGBColor(213, 94, 0);
const BAND: RGBColor = RGBColor(225, 225, 225);
const SHEET_WIDTH: u32 = 1200;
const PANEL_HEIGHT: u32 = 190;
const TITLE_HEIGHT: u32 = 78;

/// A body's residuals, drawn.
#[derive(Debug, Clone, PartialEq)]
pub struct Plot {
    /// The body's name.
    pub body: String,
    /// The picture: SVG.
    pub svg: String,
}

type DrawResult = std::result::Result<(), Box<dyn std::error::Error>>;
type Sheet<'a> = DrawingArea<SVGBackend<'a>, Shift>;

/// Draws the residuals (pose minus model) of `result`, called `name`, over time: for each body of
/// `scene` a picture with a panel for each axis, the noise's band of ±2 σ, and the collision. None
/// where the result has no collision time.
///
/// # Errors
/// As [`super::channels`].
pub fn plots(scene: &Scene, name: &str, result: &Reconstruction) -> Result<Vec<Plot>> {
    let Some(collision_time_s) = result.collision_time.value else { return Ok(Vec::new()) };
    let all = series(scene, result)?;
    let plots = scene.bodies().iter().map(|body| {
        let picture = Picture {
            title: format!("{name}: {}, poses minus model", body.name),
            collision_time_s,
            columns: [Channel::Position, Channel::Orientation].map(|channel| {
                let of_column = all.iter().filter(|s| s.body == body.name && s.channel == channel);
                of_column.map(Panel::new).collect()
            }),
        };
        Plot { body: body.name.clone(), svg: picture.svg() }
    });
    Ok(plots.collect())
}

/// All that is drawn of a body.
struct Picture {
    title: String,
    collision_time_s: f64,
    /// Of positions, and of orientations.
    columns: [Vec<Panel>; 2],
}

/// What is drawn along an axis, in mm or degrees.
struct Panel {
    axis: Axis,
    sigma: Option<f64>,
    /// Times in s, and residuals; before, then after.
    series: [Vec<(f64, f64)>; 2],
}

impl Panel {
    fn new(drawn: &ResidualSeries) -> Panel {
        let scale = match drawn.channel {
            Channel::Position => 1e3,
            Channel::Orientation => 1_f64.to_degrees(),
        };
        let of_segment = |segment| {
            let points = drawn.points.iter().filter(|point| point.segment == segment);
            points.map(|point| (point.time, scale * point.value)).collect()
        };
        Panel {
            axis: drawn.axis,
            sigma: drawn.sigma.map(|sigma| scale * sigma),
            series: [Segment::Before, Segment::After].map(of_segment),
        }
    }
}

impl Picture {
    fn svg(&self) -> String {
        let columns: Vec<&Vec<Panel>> = self.columns.iter().filter(|one| !one.is_empty()).collect();
        let rows = columns.iter().map(|column| column.len()).max().unwrap_or(0);
        let size = (SHEET_WIDTH, TITLE_HEIGHT + rows as u32 * PANEL_HEIGHT);
        let mut svg = String::new();
        let sheet = SVGBackend::with_string(&mut svg, size).into_drawing_area();
        self.draw(&sheet, &columns, rows).expect("drawing into a string can't fail");
        drop(sheet);
        svg
    }

    fn draw(&self, sheet: &Sheet, columns: &[&Vec<Panel>], rows: usize) -> DrawResult {
        sheet.fill(&WHITE)?;
        let (head, body) = sheet.split_vertically(TITLE_HEIGHT);
        head.draw_text(&self.title, &("sans-serif", 22).into_text_style(&head), (16, 12))?;
        let how_to_read = "How to read it: noise scatters about 0 without order, 19 of 20 poses \
                           within the grey band (±2 σ); a row of poses on one side, a slope or a \
                           bend is physics that the model lacks.";
        head.draw_text(how_to_read, &("sans-serif", 14).into_text_style(&head), (16, 40))?;
        let legend =
            "Circles: before the collision. Triangles: after it. Dashed line: the collision.";
        head.draw_text(legend, &("sans-serif", 14).into_text_style(&head), (16, 58))?;
        let areas = body.split_evenly((rows.max(1), columns.len().max(1)));
        for (column, panels) in columns.iter().enumerate() {
            for (row, panel) in panels.iter().enumerate() {
                self.draw_panel(&areas[row * columns.len() + column], panel)?;
            }
        }
        sheet.present()?;
        Ok(())
    }

    fn draw_panel(&self, area: &Sheet, panel: &Panel) -> DrawResult {
        let (from, to) = self.times();
        let all = panel.series.iter().flatten();
        let largest = all.map(|(_, value)| value.abs()).fold(0.0, f64::max);
        let half = (1.15 * largest).max(2.6 * panel.sigma.unwrap_or(0.0)).max(f64::MIN_POSITIVE);
        let unit = match panel.axis.channel() {
            Channel::Position => "mm",
            Channel::Orientation => "°",
        };
        let mut chart = ChartBuilder::on(area)
            .caption(format!("{} ({unit})", panel.axis.label()), ("sans-serif", 15))
            .margin(6)
            .x_label_area_size(24)
            .y_label_area_size(52)
            .build_cartesian_2d(from..to, -half..half)?;
        if let Some(sigma) = panel.sigma {
            let corners = [(from, -2.0 * sigma), (to, 2.0 * sigma)];
            chart.draw_series([Rectangle::new(corners, BAND.filled())])?;
        }
        chart
            .configure_mesh()
            .disable_mesh()
            .x_labels(8)
            .y_labels(5)
            .x_label_formatter(&|time| format!("{time:.2} s"))
            .y_label_formatter(&|value| format!("{value:.2}"))
            .draw()?;
        chart.draw_series([PathElement::new([(from, 0.0), (to, 0.0)], BLACK.mix(0.5))])?;
        let at = self.collision_time_s;
        let dashes = DashedLineSeries::new([(at, -half), (at, half)], 5, 4, BLACK.stroke_width(1));
        chart.draw_series(dashes)?;
        let [before, after] = &panel.series;
        chart.draw_series(before.iter().map(|&dot| Circle::new(dot, 4, BEFORE.filled())))?;
        chart.draw_series(after.iter().map(|&dot| TriangleMarker::new(dot, 6, AFTER.filled())))?;
        Ok(())
    }

    /// All times that are drawn, with a margin.
    fn times(&self) -> (f64, f64) {
        let panels = self.columns.iter().flatten();
        let times = panels.flat_map(|panel| panel.series.iter().flatten()).map(|(time, _)| *time);
        let (from, to) = times
            .fold((self.collision_time_s, self.collision_time_s), |(from, to), time| {
                (from.min(time), to.max(time))
            });
        let margin = 0.03 * (to - from).max(1e-6);
        (from - margin, to + margin)
    }
}
