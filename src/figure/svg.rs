//! Writes a figure as SVG. Text stays text, so that an editor can change it; the font is only named.

use super::canvas::{Page, Primitive, Rgb};
use super::font::FAMILY;
use crate::math::number::exact;
use crate::scenario::escape::xml;

/// Returns the whole file.
pub fn write(canvas: &Page) -> String {
    let [width, height] = canvas.size.map(length);
    let mut text = format!(
        "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<svg xmlns=\"http://www.w3.org/2000/svg\" \
         width=\"{width}mm\" height=\"{height}mm\" viewBox=\"0 0 {width} {height}\" \
         font-family=\"{FAMILY}, Arial, Helvetica, sans-serif\">\n<title>{}</title>\n<desc>{}</desc>\n\
         <rect width=\"{width}\" height=\"{height}\" fill=\"#ffffff\"/>\n",
        xml(&canvas.title),
        xml(&canvas.caption()),
    );
    for shape in &canvas.shapes {
        text.push_str(&element(shape));
        text.push('\n');
    }
    text.push_str("</svg>\n");
    text
}

fn element(shape: &Primitive) -> String {
    match shape {
        Primitive::Line(line) => {
            let points = line.points.iter().map(|point| point.map(length).join(","));
            let points: Vec<String> = points.collect();
            let dashes: Vec<String> = line.dashes.iter().map(|&dash| length(dash)).collect();
            let dashes = if dashes.is_empty() {
                String::new()
            } else {
                format!(" stroke-dasharray=\"{}\"", dashes.join(" "))
            };
            format!(
                "<polyline points=\"{}\" fill=\"none\" stroke=\"{}\" stroke-width=\"{}\" \
                 stroke-linejoin=\"round\"{dashes}/>",
                points.join(" "),
                hex(line.ink),
                length(line.width),
            )
        }
        Primitive::Area { at, size, ink } => {
            let ([x, y], [width, height]) = (at.map(length), size.map(length));
            format!(
                "<rect x=\"{x}\" y=\"{y}\" width=\"{width}\" height=\"{height}\" fill=\"{}\" \
                 shape-rendering=\"crispEdges\"/>",
                hex(*ink),
            )
        }
        Primitive::Text(text) => {
            let [x, y] = text.at.map(length);
            let turned = if text.upwards {
                format!(" transform=\"rotate(-90 {x} {y})\"")
            } else {
                String::new()
            };
            format!(
                "<text x=\"{x}\" y=\"{y}\" font-size=\"{}\" text-anchor=\"{}\"{turned}>{}</text>",
                length(text.size),
                text.anchor,
                xml(&text.words),
            )
        }
    }
}

/// Returns a colour in SVG notation.
pub fn hex([red, green, blue]: Rgb) -> String {
    format!("#{red:02x}{green:02x}{blue:02x}")
}

/// Rounds to one micrometre, which is fine enough on paper.
fn length(value: f64) -> String {
    exact((1e3 * value).round() / 1e3)
}
