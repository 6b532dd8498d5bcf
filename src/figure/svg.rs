//! A figure as SVG: words stay words, so that an editor can change them; the font is named.

use std::fmt::Write;

use super::canvas::{Anchor, Canvas, Rgb, Shape};
use super::font::FAMILY;

/// The whole file.
pub fn write(canvas: &Canvas) -> String {
    let [width, height] = canvas.size.map(length);
    let mut text = format!(
        "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<svg xmlns=\"http://www.w3.org/2000/svg\" \
         width=\"{width}mm\" height=\"{height}mm\" viewBox=\"0 0 {width} {height}\" \
         font-family=\"{FAMILY}, Arial, Helvetica, sans-serif\">\n<title>{}</title>\n<desc>{}</desc>\n\
         <rect width=\"{width}\" height=\"{height}\" fill=\"#ffffff\"/>\n",
        escaped(&canvas.title),
        escaped(&canvas.caption()),
    );
    for shape in &canvas.shapes {
        text.push_str(&element(shape));
        text.push('\n');
    }
    text.push_str("</svg>\n");
    text
}

fn element(shape: &Shape) -> String {
    match shape {
        Shape::Line {
            points,
            ink,
            width,
            dashes,
        } => {
            let mut path = String::new();
            for [x, y] in points {
                let _ = write!(path, "{},{} ", length(*x), length(*y));
            }
            let dashes: Vec<String> = dashes.iter().map(|&dash| length(dash)).collect();
            let dashes = match dashes.is_empty() {
                true => String::new(),
                false => format!(" stroke-dasharray=\"{}\"", dashes.join(" ")),
            };
            format!(
                "<polyline points=\"{}\" fill=\"none\" stroke=\"{}\" stroke-width=\"{}\" \
                 stroke-linejoin=\"round\"{dashes}/>",
                path.trim_end(),
                color(*ink),
                length(*width),
            )
        }
        Shape::Area { at, size, ink } => format!(
            "<rect x=\"{}\" y=\"{}\" width=\"{}\" height=\"{}\" fill=\"{}\" \
             shape-rendering=\"crispEdges\"/>",
            length(at[0]),
            length(at[1]),
            length(size[0]),
            length(size[1]),
            color(*ink),
        ),
        Shape::Text {
            at,
            words,
            size,
            anchor,
            upwards,
        } => {
            let [x, y] = at.map(length);
            let anchor = match anchor {
                Anchor::Start => "start",
                Anchor::Middle => "middle",
                Anchor::End => "end",
            };
            let turned = match upwards {
                true => format!(" transform=\"rotate(-90 {x} {y})\""),
                false => String::new(),
            };
            format!(
                "<text x=\"{x}\" y=\"{y}\" font-size=\"{}\" text-anchor=\"{anchor}\"{turned}>{}</text>",
                length(*size),
                escaped(words),
            )
        }
    }
}

/// A resolution of one micrometre on paper is enough.
fn length(value: f64) -> String {
    let text = format!("{value:.3}");
    let text = text.trim_end_matches('0').trim_end_matches('.');
    if text == "-0" {
        "0".into()
    } else {
        text.into()
    }
}

fn color([red, green, blue]: Rgb) -> String {
    format!("#{red:02x}{green:02x}{blue:02x}")
}

fn escaped(text: &str) -> String {
    let mut safe = String::with_capacity(text.len());
    for sign in text.chars() {
        match sign {
            '&' => safe.push_str("&amp;"),
            '<' => safe.push_str("&lt;"),
            '>' => safe.push_str("&gt;"),
            '"' => safe.push_str("&quot;"),
            '\n' => safe.push('\n'),
            sign if sign.is_control() => safe.push(' '),
            sign => safe.push(sign),
        }
    }
    safe
}
