//! Writes a figure as PNG, with its resolution in the file and the caption's facts as text.

use std::io;

use png::{BitDepth, ColorType, Encoder, PixelDimensions, Unit};
use tiny_skia::{
    Color, FillRule, LineJoin, Paint, PathBuilder, Pixmap, Rect, Stroke, StrokeDash, Transform,
};
use ttf_parser::OutlineBuilder;

use super::canvas::{BLACK, Page, Primitive, Rgb};
use super::font;

const INCH: f64 = 25.4;

/// Maximum number of pixels, some 400 MB.
const MOST_PIXELS: f64 = 1e8;

/// Returns the whole file at `dpi` dots per inch.
///
/// # Errors
/// If the image has no pixels or more than 1e8, or the encoder rejects the text.
pub fn write(canvas: &Page, dpi: f64) -> io::Result<Vec<u8>> {
    let scale = dpi / INCH;
    let [width, height] = canvas.size.map(|length| (length * scale).round());
    let refused = || {
        let rule = format!("{width:.0} by {height:.0} pixels: an image has 1 to 1e8 pixels");
        io::Error::other(rule)
    };
    if !(width >= 1.0 && height >= 1.0 && width * height <= MOST_PIXELS) {
        return Err(refused());
    }
    let mut pixels = Pixmap::new(width as u32, height as u32).ok_or_else(refused)?;
    pixels.fill(Color::WHITE);
    let to_pixels = Transform::from_scale(scale as f32, scale as f32);
    for shape in &canvas.shapes {
        draw(shape, &mut pixels, to_pixels);
    }
    let mut file = Vec::new();
    let mut encoder = Encoder::new(&mut file, width as u32, height as u32);
    encoder.set_color(ColorType::Rgba);
    encoder.set_depth(BitDepth::Eight);
    let per_meter = (1000.0 * scale).round() as u32;
    encoder.set_pixel_dims(Some(PixelDimensions {
        xppu: per_meter,
        yppu: per_meter,
        unit: Unit::Meter,
    }));
    encoder.add_itxt_chunk("Title".into(), canvas.title.clone())?;
    encoder.add_itxt_chunk("Description".into(), canvas.caption())?;
    let mut writer = encoder.write_header()?;
    // Nothing is transparent, so premultiplied colours equal plain ones.
    writer.write_image_data(pixels.data())?;
    writer.finish()?;
    Ok(file)
}

fn draw(shape: &Primitive, pixels: &mut Pixmap, to_pixels: Transform) {
    match shape {
        Primitive::Line(line) => {
            let dashes = line.dashes.iter().map(|&dash| dash as f32).collect();
            let stroke = Stroke {
                width: line.width as f32,
                line_join: LineJoin::Round,
                dash: StrokeDash::new(dashes, 0.0),
                ..Stroke::default()
            };
            let mut path = PathBuilder::new();
            for (k, point) in line.points.iter().enumerate() {
                let [x, y] = point.map(|v| v as f32);
                match k {
                    0 => path.move_to(x, y),
                    _ => path.line_to(x, y),
                }
            }
            if let Some(path) = path.finish() {
                pixels.stroke_path(&path, &paint(line.ink), &stroke, to_pixels, None);
            }
        }
        Primitive::Area { at, size, ink } => {
            let [x, y, w, h] = [at[0], at[1], size[0], size[1]].map(|v| v as f32);
            if let Some(area) = Rect::from_xywh(x, y, w, h) {
                let mut paint = paint(*ink);
                // Without antialiasing, neighbouring areas of a map show no seam.
                paint.anti_alias = false;
                pixels.fill_rect(area, &paint, to_pixels, None);
            }
        }
        Primitive::Text(text) => {
            let before = text.anchor.share_before() * font::width(&text.words);
            let [x, y, size] = [text.at[0], text.at[1], text.size].map(|v| v as f32);
            let place = to_pixels
                .pre_translate(x, y)
                .pre_rotate(if text.upwards { -90.0 } else { 0.0 })
                .pre_scale(size, -size);
            let unit = font::unit() as f32;
            for (_, glyph, at, _) in font::glyphs(&text.words) {
                let mut pen = GlyphPen(PathBuilder::new());
                font::FACE.outline_glyph(glyph, &mut pen);
                if let Some(path) = pen.0.finish() {
                    let place = place.pre_translate((at - before) as f32, 0.0);
                    let place = place.pre_scale(unit, unit);
                    pixels.fill_path(&path, &paint(BLACK), FillRule::Winding, place, None);
                }
            }
        }
    }
}

fn paint([red, green, blue]: Rgb) -> Paint<'static> {
    let mut paint = Paint::default();
    paint.set_color_rgba8(red, green, blue, 255);
    paint
}

/// Makes a path from a glyph's outline.
struct GlyphPen(PathBuilder);

impl OutlineBuilder for GlyphPen {
    fn move_to(&mut self, x: f32, y: f32) {
        self.0.move_to(x, y);
    }

    fn line_to(&mut self, x: f32, y: f32) {
        self.0.line_to(x, y);
    }

    fn quad_to(&mut self, x1: f32, y1: f32, x: f32, y: f32) {
        self.0.quad_to(x1, y1, x, y);
    }

    fn curve_to(&mut self, x1: f32, y1: f32, x2: f32, y2: f32, x: f32, y: f32) {
        self.0.cubic_to(x1, y1, x2, y2, x, y);
    }

    fn close(&mut self) {
        self.0.close();
    }
}
