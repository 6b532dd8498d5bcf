//! Writes a figure as PDF: one page of the figure's size, vector lines, and the embedded font, so that text can be
//! searched and copied.

use miniz_oxide::deflate::compress_to_vec_zlib;
use pdf_writer::types::{CidFontType, FontFlags, LineJoinStyle, SystemInfo, UnicodeCmap};
use pdf_writer::{Content, Filter, Finish, Name, Pdf, Rect, Ref, Str, TextStr};

use super::canvas::{Page, Primitive, Rgb};
use super::font;

/// Points per millimetre.
const POINTS: f64 = 72.0 / 25.4;

/// Names of the font inside the file.
const BASE_FONT: Name<'static> = Name(b"NotoSans-Regular");
const FONT: Name<'static> = Name(b"F1");
const CMAP: Name<'static> = Name(b"Custom");

/// Adobe-Identity-0: glyphs are addressed by number.
const IDENTITY: SystemInfo<'static> = SystemInfo {
    registry: Str(b"Adobe"),
    ordering: Str(b"Identity"),
    supplement: 0,
};

/// Compression level of the font and the page, 0 to 10.
const EFFORT: u8 = 6;

/// The font's object, to which the page refers.
const FONT_OBJECT: Ref = Ref::new(6);

/// Returns the whole file.
pub fn write(canvas: &Page) -> Vec<u8> {
    let [catalog, pages, page, contents, info] = [1, 2, 3, 4, 5].map(Ref::new);
    let mut pdf = Pdf::new();
    pdf.catalog(catalog).pages(pages);
    pdf.pages(pages).kids([page]).count(1);
    let [width, height] = canvas.size.map(|length| (length * POINTS) as f32);
    let mut sheet = pdf.page(page);
    sheet.media_box(Rect::new(0.0, 0.0, width, height));
    sheet.parent(pages);
    sheet.contents(contents);
    sheet.resources().fonts().pair(FONT, FONT_OBJECT);
    sheet.finish();
    let mut drawing = Content::new();
    let scale = POINTS as f32;
    // Millimetres from the upper left corner; text is flipped upright again.
    drawing.transform([scale, 0.0, 0.0, -scale, 0.0, height]);
    for shape in &canvas.shapes {
        draw(shape, &mut drawing);
    }
    let drawing = compress_to_vec_zlib(&drawing.finish(), EFFORT);
    pdf.stream(contents, &drawing).filter(Filter::FlateDecode);
    embed_font(&mut pdf, canvas);
    let caption = canvas.caption();
    let version = concat!("mdr-tui ", env!("CARGO_PKG_VERSION"));
    pdf.document_info(info)
        .title(TextStr(&canvas.title))
        .subject(TextStr(&caption))
        .creator(TextStr(version));
    pdf.finish()
}

fn draw(shape: &Primitive, drawing: &mut Content) {
    match shape {
        Primitive::Line(line) => {
            let [red, green, blue] = shares(line.ink);
            drawing.set_stroke_rgb(red, green, blue);
            drawing.set_line_width(line.width as f32);
            drawing.set_line_join(LineJoinStyle::RoundJoin);
            drawing.set_dash_pattern(line.dashes.iter().map(|&dash| dash as f32), 0.0);
            for (k, point) in line.points.iter().enumerate() {
                let [x, y] = point.map(|v| v as f32);
                match k {
                    0 => drawing.move_to(x, y),
                    _ => drawing.line_to(x, y),
                };
            }
            drawing.stroke();
        }
        Primitive::Area { at, size, ink } => {
            let [red, green, blue] = shares(*ink);
            drawing.set_fill_rgb(red, green, blue);
            let [x, y, w, h] = [at[0], at[1], size[0], size[1]].map(|v| v as f32);
            drawing.rect(x, y, w, h);
            drawing.fill_nonzero();
        }
        Primitive::Text(text) => {
            let before = text.anchor.share_before() * font::width(&text.words) * text.size;
            let glyphs = font::glyphs(&text.words).into_iter();
            let codes: Vec<u8> = glyphs.flat_map(|glyph| glyph.1.0.to_be_bytes()).collect();
            let [x, y] = text.at;
            let matrix = if text.upwards {
                [0.0, -1.0, -1.0, 0.0, x, y + before]
            } else {
                [1.0, 0.0, 0.0, -1.0, x - before, y]
            };
            drawing.set_fill_rgb(0.0, 0.0, 0.0);
            drawing.begin_text();
            drawing.set_font(FONT, text.size as f32);
            drawing.set_text_matrix(matrix.map(|v| v as f32));
            drawing.show(Str(&codes));
            drawing.end_text();
        }
    }
}

fn shares(ink: Rgb) -> [f32; 3] {
    ink.map(|part| f32::from(part) / 255.0)
}

/// Embeds the font, with the widths and Unicode values of the glyphs used.
fn embed_font(pdf: &mut Pdf, canvas: &Page) {
    let [cid_font, described, to_unicode, file] = [7, 8, 9, 10].map(Ref::new);
    let texts = canvas.shapes.iter().filter_map(|shape| match shape {
        Primitive::Text(text) => Some(text.words.as_str()),
        _ => None,
    });
    let mut used: Vec<(u16, char, f64)> = texts
        .flat_map(font::glyphs)
        .map(|(sign, glyph, _, advance)| (glyph.0, sign, advance))
        .collect();
    used.sort_by_key(|&(glyph, sign, _)| (glyph, sign));
    used.dedup_by_key(|(glyph, _, _)| *glyph);
    pdf.type0_font(FONT_OBJECT)
        .base_font(BASE_FONT)
        .encoding_predefined(Name(b"Identity-H"))
        .descendant_font(cid_font)
        .to_unicode(to_unicode);
    let mut cid = pdf.cid_font(cid_font);
    cid.subtype(CidFontType::Type2);
    cid.base_font(BASE_FONT);
    cid.system_info(IDENTITY);
    cid.font_descriptor(described);
    cid.cid_to_gid_map_predefined(Name(b"Identity"));
    let mut widths = cid.widths();
    for &(glyph, _, advance) in &used {
        widths.same(glyph, glyph, (1000.0 * advance) as f32);
    }
    widths.finish();
    cid.finish();
    let mut cmap = UnicodeCmap::new(CMAP, IDENTITY);
    for &(glyph, sign, _) in &used {
        cmap.pair(glyph, sign);
    }
    pdf.stream(to_unicode, &cmap.finish().into_vec());
    let mut descriptor = pdf.font_descriptor(described);
    descriptor
        .name(BASE_FONT)
        .flags(FontFlags::NON_SYMBOLIC)
        .italic_angle(0.0)
        .stem_v(80.0)
        .font_file2(file);
    let (face, bounds) = (&font::FACE, font::FACE.global_bounding_box());
    let scaled = |length: i16| f32::from(length) * 1000.0 / f32::from(face.units_per_em());
    let [left, low] = [bounds.x_min, bounds.y_min].map(scaled);
    let [right, high] = [bounds.x_max, bounds.y_max].map(scaled);
    descriptor
        .bbox(Rect::new(left, low, right, high))
        .ascent(scaled(face.ascender()))
        .descent(scaled(face.descender()))
        .cap_height(scaled(face.capital_height().unwrap_or(714)));
    descriptor.finish();
    let packed = compress_to_vec_zlib(font::FILE, EFFORT);
    let mut stream = pdf.stream(file, &packed);
    stream.filter(Filter::FlateDecode);
    stream.pair(Name(b"Length1"), font::FILE.len() as i32);
}
