//! Growth as pictures.

use crate::error::{BenchError, Result};
use crate::growth::Curve;
use plotters::prelude::*;
use std::path::{Path, PathBuf};

const COLOURS: [RGBColor; 9] = [
    RGBColor(31, 119, 180),
    RGBColor(255, 127, 14),
    RGBColor(44, 160, 44),
    RGBColor(214, 39, 40),
    RGBColor(148, 103, 189),
    RGBColor(140, 86, 75),
    RGBColor(227, 119, 194),
    RGBColor(127, 127, 127),
    RGBColor(23, 190, 207),
];

const WIDTH: u32 = 900;
const LEGEND_WIDTH: u32 = 180;

/// Draws ours, and all libraries at one delta, into a folder; the files.
pub fn plots(curves: &[Curve], folder: &Path) -> Result<Vec<PathBuf>> {
    if curves.is_empty() {
        return Ok(Vec::new());
    }
    std::fs::create_dir_all(folder)
        .map_err(|source| BenchError::Write { path: folder.to_owned(), source })?;
    let (ours, peers) = (folder.join("growth.svg"), folder.join("growth-peers.svg"));
    let all: Vec<(&str, &Curve)> =
        curves.iter().filter(|curve| curve.library == "dsr").map(|curve| (curve.id, curve)).collect();
    plot(&ours, "dsr-core: time by size of the graph", &all)?;
    let spread: Vec<(&str, &Curve)> = curves
        .iter()
        .filter(|curve| curve.id == "apply/spread")
        .map(|curve| (curve.library, curve))
        .collect();
    plot(&peers, "a delta of one attribute is applied, anywhere in the graph", &spread)?;
    Ok(vec![ours, peers])
}

#[allow(clippy::cast_precision_loss, reason = "sizes are small")]
fn plot(path: &Path, title: &str, curves: &[(&str, &Curve)]) -> Result<()> {
    let failed = |error: &dyn std::fmt::Display| BenchError::Plot(format!("{}: {error}", path.display()));
    let points = || curves.iter().flat_map(|(_, curve)| curve.points.iter().copied());
    let largest = points().map(|(n, _)| n).max().unwrap_or(1000) as f64;
    let least = points().map(|(_, ns)| ns).fold(f64::INFINITY, f64::min);
    let greatest = points().map(|(_, ns)| ns).fold(1.0, f64::max);
    let area = SVGBackend::new(path, (WIDTH, 520)).into_drawing_area();
    area.fill(&WHITE).map_err(|error| failed(&error))?;
    let (graph, legend) = area.split_horizontally(WIDTH - LEGEND_WIDTH);
    let mut chart = ChartBuilder::on(&graph)
        .caption(title, ("sans-serif", 20))
        .margin(16)
        .x_label_area_size(44)
        .y_label_area_size(70)
        .build_cartesian_2d((100.0..largest * 1.05).log_scale(), (least * 0.7..greatest * 1.5).log_scale())
        .map_err(|error| failed(&error))?;
    chart
        .configure_mesh()
        .x_desc("vertices")
        .y_desc("ns per operation")
        .light_line_style(WHITE)
        .x_label_formatter(&|n| format!("{n:.0}"))
        .y_label_formatter(&|ns| format!("{ns:.0}"))
        .draw()
        .map_err(|error| failed(&error))?;
    for (((name, curve), colour), row) in curves.iter().zip(COLOURS.into_iter().cycle()).zip(0..) {
        let points: Vec<(f64, f64)> = curve.points.iter().map(|&(n, ns)| (n as f64, ns)).collect();
        chart
            .draw_series(LineSeries::new(points.iter().copied(), colour.stroke_width(2)).point_size(3))
            .map_err(|error| failed(&error))?;
        let (y, label) = (60 + 24 * row, format!("{name}  n^{:.2}", curve.exponent()));
        let line = PathElement::new([(0, y), (18, y)], colour.stroke_width(2));
        legend.draw(&line).map_err(|error| failed(&error))?;
        let text = Text::new(label, (26, y - 7), ("sans-serif", 14));
        legend.draw(&text).map_err(|error| failed(&error))?;
    }
    area.present().map_err(|error| failed(&error))
}
