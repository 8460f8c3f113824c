//! The figure, after the paper's Figure 6: errors of mass ratio and restitution against the
//! interval, by noise and method.

use std::path::Path;

use plotters::coord::Shift;
use plotters::prelude::*;
use smash::Result;
use smash::files::Output;

use crate::score::{Outcome, Score};

type DrawResult = std::result::Result<(), Box<dyn std::error::Error>>;
type Panel<'a> = DrawingArea<SVGBackend<'a>, Shift>;

/// Okabe and Ito's colours, told apart by the colour-blind too.
const COLOURS: [RGBColor; 4] =
    [RGBColor(0, 114, 178), RGBColor(0, 158, 115), RGBColor(230, 159, 0), RGBColor(213, 94, 0)];
/// Errors below are drawn here: they don't differ for a user.
const SMALLEST: f64 = 1e-10;
const LARGEST: f64 = 10.0;

/// Draws the figure into `file`, as SVG.
pub fn draw(scores: &[Score], file: &Path) -> Result<()> {
    let mut svg = String::new();
    draw_panels(scores, &mut svg).expect("drawing into a string can't fail");
    Output::check(file, &[])?.write(svg.as_bytes())
}

fn draw_panels(scores: &[Score], svg: &mut String) -> DrawResult {
    let sheet = SVGBackend::with_string(svg, (1200, 720)).into_drawing_area();
    sheet.fill(&WHITE)?;
    let mut methods: Vec<&str> = scores.iter().map(|score| score.method).collect();
    methods.dedup();
    methods.sort_unstable();
    methods.dedup();
    let panels = sheet.split_evenly((2, methods.len()));
    for (column, method) in methods.iter().enumerate() {
        let of_method: Vec<&Score> = scores.iter().filter(|s| s.method == *method).collect();
        let mass_ratio = format!("{method}: relative error of the mass ratio");
        let has_legend = column == 0;
        draw_panel(&panels[column], &of_method, &mass_ratio, has_legend, |o| o.mass_ratio_error)?;
        let restitution = format!("{method}: error of the restitution");
        let below = &panels[methods.len() + column];
        draw_panel(below, &of_method, &restitution, has_legend, |o| o.restitution_error)?;
    }
    sheet.present()?;
    Ok(())
}

fn draw_panel(
    panel: &Panel,
    scores: &[&Score],
    title: &str,
    has_legend: bool,
    error: fn(&Outcome) -> f64,
) -> DrawResult {
    let mut chart = ChartBuilder::on(panel)
        .caption(title, ("sans-serif", 18))
        .margin(12)
        .x_label_area_size(36)
        .y_label_area_size(56)
        .build_cartesian_2d(0.0..20.5, (SMALLEST..LARGEST).log_scale())?;
    chart
        .configure_mesh()
        .disable_x_mesh()
        .light_line_style(TRANSPARENT)
        .x_desc("frames between annotated poses")
        .x_labels(21)
        .x_label_formatter(&|x| {
            if [1.0, 4.0, 9.0, 14.0, 19.0].contains(x) { x.to_string() } else { String::new() }
        })
        .y_label_formatter(&|y| format!("{y:.0e}"))
        .draw()?;
    let mut noises: Vec<&str> = scores.iter().map(|score| score.noise_name).collect();
    noises.dedup();
    for (index, noise) in noises.iter().enumerate() {
        let colour = COLOURS[index % COLOURS.len()];
        let of_noise: Vec<&&Score> = scores.iter().filter(|s| s.noise_name == *noise).collect();
        // Beside each other, so that one noise doesn't hide another.
        let x = |score: &Score| f64::from(score.interval) + 0.35 * (index as f64 - 1.5);
        let y = |value: f64| value.clamp(SMALLEST, LARGEST);
        let dots = of_noise.iter().flat_map(|score| {
            let errors = score.outcomes.iter().map(error).filter(|error| error.is_finite());
            errors.map(move |error| (x(score), y(error)))
        });
        chart.draw_series(dots.map(|dot| Circle::new(dot, 2, colour.mix(0.35).filled())))?;
        let medians: Vec<(f64, f64)> =
            of_noise.iter().map(|score| (x(score), y(score.quantile(0.5, error)))).collect();
        chart
            .draw_series(LineSeries::new(medians.clone(), colour.stroke_width(2)))?
            .label(format!("noise: {noise}"))
            .legend(move |(x, y)| PathElement::new([(x, y), (x + 18, y)], colour.stroke_width(3)));
        chart.draw_series(medians.iter().map(|&dot| Circle::new(dot, 5, colour.filled())))?;
    }
    if !has_legend {
        return Ok(());
    }
    chart
        .configure_series_labels()
        .position(SeriesLabelPosition::LowerLeft)
        .background_style(WHITE.mix(0.8))
        .border_style(BLACK.mix(0.3))
        .draw()?;
    Ok(())
}
