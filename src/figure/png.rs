//! A figure as PNG, at a resolution that the file states; the caption's facts are in its text.

use png::{BitDepth, ColorType, Encoder, EncodingError, PixelDimensions, Unit};
use tiny_skia::{
    Color, FillRule, LineJoin, Paint, Path, PathBuilder, Pixmap, Rect, Stroke, StrokeDash,
    Transform,
};

use super::canvas::{BLACK, Canvas, Rgb, Shape};
use super::font;

const INCH: f64 = 25.4;

/// The most pixels of an image: some 400 MB.
const MOST_PIXELS: f64 = 1e8;

/// Why there is no image.
#[derive(Debug, thiserror::Error)]
pub enum PngError {
    /// Too large, or nothing.
    #[error("{width:.0} by {height:.0} pixels: an image has 1 to 1e8 pixels")]
    Size {
        /// Pixels across.
        width: f64,
        /// Pixels down.
        height: f64,
    },
    /// The encoder refused.
    #[error(transparent)]
    Encoding(#[from] EncodingError),
}

/// The whole file at `dpi` dots per inch.
///
/// # Errors
/// [`PngError::Size`] if the image has no pixel or more than 1e8; [`PngError::Encoding`] if the
/// encoder refuses the text.
pub fn write(canvas: &Canvas, dpi: f64) -> Result<Vec<u8>, PngError> {
    let scale = dpi / INCH;
    let [width, height] = canvas.size.map(|length| (length * scale).round());
    let refused = || PngError::Size { width, height };
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
    // Nothing is transparent, so premultiplied colours are plain ones.
    writer.write_image_data(pixels.data())?;
    writer.finish()?;
    Ok(file)
}

fn draw(shape: &Shape, pixels: &mut Pixmap, to_pixels: Transform) {
    match shape {
        Shape::Line {
            points,
            ink,
            width,
            dashes,
        } => {
            let dashes = dashes.iter().map(|&dash| dash as f32).collect();
            let stroke = Stroke {
                width: *width as f32,
                line_join: LineJoin::Round,
                dash: StrokeDash::new(dashes, 0.0),
                ..Stroke::default()
            };
            if let Some(path) = polyline(points) {
                pixels.stroke_path(&path, &paint(*ink), &stroke, to_pixels, None);
            }
        }
        Shape::Area { at, size, ink } => {
            let [x, y, w, h] = [at[0], at[1], size[0], size[1]].map(|v| v as f32);
            if let Some(area) = Rect::from_xywh(x, y, w, h) {
                let mut paint = paint(*ink);
                // Neighbouring areas of a map show no seam.
                paint.anti_alias = false;
                pixels.fill_rect(area, &paint, to_pixels, None);
            }
        }
        Shape::Text {
            at,
            words,
            size,
            anchor,
            upwards,
        } => {
            let before = anchor.share_before() * font::width(words);
            let Some(path) = outline(words, before) else {
                return;
            };
            let turn = if *upwards { -90.0 } else { 0.0 };
            let place = to_pixels
                .pre_translate(at[0] as f32, at[1] as f32)
                .pre_rotate(turn)
                .pre_scale(*size as f32, -*size as f32);
            pixels.fill_path(&path, &paint(BLACK), FillRule::Winding, place, None);
        }
    }
}

fn paint([red, green, blue]: Rgb) -> Paint<'static> {
    let mut paint = Paint::default();
    paint.set_color_rgba8(red, green, blue, 255);
    paint
}

fn polyline(points: &[[f64; 2]]) -> Option<Path> {
    let mut path = PathBuilder::new();
    for (k, point) in points.iter().enumerate() {
        let [x, y] = point.map(|v| v as f32);
        if k == 0 {
            path.move_to(x, y);
        } else {
            path.line_to(x, y);
        }
    }
    path.finish()
}

/// The outlines of a text of size 1, its beginning at −`before`.
fn outline(words: &str, before: f64) -> Option<Path> {
    let mut path = PathBuilder::new();
    let place = |[x, y]: [f64; 2]| [(x - before) as f32, y as f32];
    font::outline(words, &mut |stroke| match stroke {
        font::Stroke::Move(to) => {
            let [x, y] = place(to);
            path.move_to(x, y);
        }
        font::Stroke::Line(to) => {
            let [x, y] = place(to);
            path.line_to(x, y);
        }
        font::Stroke::Quad(by, to) => {
            let ([x1, y1], [x, y]) = (place(by), place(to));
            path.quad_to(x1, y1, x, y);
        }
        font::Stroke::Cubic(first, second, to) => {
            let ([x1, y1], [x2, y2], [x, y]) = (place(first), place(second), place(to));
            path.cubic_to(x1, y1, x2, y2, x, y);
        }
        font::Stroke::Close => path.close(),
    });
    path.finish()
}
