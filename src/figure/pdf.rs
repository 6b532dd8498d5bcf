//! A figure as PDF: one page of the figure's size, vector lines, and the font embedded, so that words
//! can be searched and copied.

use miniz_oxide::deflate::compress_to_vec_zlib;
use pdf_writer::types::{CidFontType, FontFlags, SystemInfo, UnicodeCmap};
use pdf_writer::{Content, Filter, Finish, Name, Pdf, Rect, Ref, Str, TextStr};

use super::canvas::{Canvas, Rgb, Shape};
use super::font;

/// Points of a millimetre.
const POINTS: f64 = 72.0 / 25.4;

/// What the font is called inside of the file.
const BASE_FONT: Name<'static> = Name(b"NotoSans-Regular");
const FONT: Name<'static> = Name(b"F1");
const CMAP: Name<'static> = Name(b"Custom");

/// Adobe-Identity-0: glyphs by their number.
const IDENTITY: SystemInfo<'static> = SystemInfo {
    registry: Str(b"Adobe"),
    ordering: Str(b"Identity"),
    supplement: 0,
};

/// How hard the font and the page are compressed: 0 to 10.
const EFFORT: u8 = 6;

/// The whole file.
pub fn write(canvas: &Canvas) -> Vec<u8> {
    let [catalog, pages, page, contents, info] = [1, 2, 3, 4, 5].map(Ref::new);
    let mut pdf = Pdf::new();
    pdf.catalog(catalog).pages(pages);
    pdf.pages(pages).kids([page]).count(1);
    let [width, height] = canvas.size.map(|length| (length * POINTS) as f32);
    let fonts = FontRefs::default();
    let mut sheet = pdf.page(page);
    sheet.media_box(Rect::new(0.0, 0.0, width, height));
    sheet.parent(pages);
    sheet.contents(contents);
    sheet.resources().fonts().pair(FONT, fonts.font);
    sheet.finish();
    let mut drawing = Content::new();
    let scale = POINTS as f32;
    // Millimetres from the upper left corner; words are turned upright again.
    drawing.transform([scale, 0.0, 0.0, -scale, 0.0, height]);
    for shape in &canvas.shapes {
        draw(shape, &mut drawing);
    }
    let drawing = compress_to_vec_zlib(&drawing.finish(), EFFORT);
    pdf.stream(contents, &drawing).filter(Filter::FlateDecode);
    embed_font(&mut pdf, &fonts, canvas);
    let caption = canvas.caption();
    let version = concat!("mdr-tui ", env!("CARGO_PKG_VERSION"));
    pdf.document_info(info)
        .title(TextStr(&canvas.title))
        .subject(TextStr(&caption))
        .creator(TextStr(version));
    pdf.finish()
}

fn draw(shape: &Shape, drawing: &mut Content) {
    match shape {
        Shape::Line {
            points,
            ink,
            width,
            dashes,
        } => {
            let [red, green, blue] = shares(*ink);
            drawing.set_stroke_rgb(red, green, blue);
            drawing.set_line_width(*width as f32);
            drawing.set_line_join(pdf_writer::types::LineJoinStyle::RoundJoin);
            drawing.set_dash_pattern(dashes.iter().map(|&dash| dash as f32), 0.0);
            for (k, point) in points.iter().enumerate() {
                let [x, y] = point.map(|v| v as f32);
                if k == 0 {
                    drawing.move_to(x, y);
                } else {
                    drawing.line_to(x, y);
                }
            }
            drawing.stroke();
        }
        Shape::Area { at, size, ink } => {
            let [red, green, blue] = shares(*ink);
            drawing.set_fill_rgb(red, green, blue);
            let [x, y, w, h] = [at[0], at[1], size[0], size[1]].map(|v| v as f32);
            drawing.rect(x, y, w, h);
            drawing.fill_nonzero();
        }
        Shape::Text {
            at,
            words,
            size,
            anchor,
            upwards,
        } => {
            let before = anchor.share_before() * font::width(words) * size;
            let codes: Vec<u8> = font::glyphs(words)
                .iter()
                .flat_map(|(_, glyph, _, _)| glyph.0.to_be_bytes())
                .collect();
            let [x, y] = *at;
            let matrix = if *upwards {
                [0.0, -1.0, -1.0, 0.0, x, y + before]
            } else {
                [1.0, 0.0, 0.0, -1.0, x - before, y]
            };
            drawing.set_fill_rgb(0.0, 0.0, 0.0);
            drawing.begin_text();
            drawing.set_font(FONT, *size as f32);
            drawing.set_text_matrix(matrix.map(|v| v as f32));
            drawing.show(Str(&codes));
            drawing.end_text();
        }
    }
}

fn shares(ink: Rgb) -> [f32; 3] {
    ink.map(|part| f32::from(part) / 255.0)
}

/// The objects that make up the font.
struct FontRefs {
    font: Ref,
    cid: Ref,
    descriptor: Ref,
    to_unicode: Ref,
    file: Ref,
}

impl Default for FontRefs {
    fn default() -> Self {
        let [font, cid, descriptor, to_unicode, file] = [6, 7, 8, 9, 10].map(Ref::new);
        Self {
            font,
            cid,
            descriptor,
            to_unicode,
            file,
        }
    }
}

/// Embeds the font, with the widths and the meanings of the glyphs that are used.
fn embed_font(pdf: &mut Pdf, refs: &FontRefs, canvas: &Canvas) {
    let texts = canvas.shapes.iter().filter_map(|shape| match shape {
        Shape::Text { words, .. } => Some(words.as_str()),
        _ => None,
    });
    let mut used: Vec<(u16, char, f64)> = texts
        .flat_map(font::glyphs)
        .map(|(sign, glyph, _, advance)| (glyph.0, sign, advance))
        .collect();
    used.sort_by_key(|&(glyph, sign, _)| (glyph, sign));
    used.dedup_by_key(|(glyph, _, _)| *glyph);
    pdf.type0_font(refs.font)
        .base_font(BASE_FONT)
        .encoding_predefined(Name(b"Identity-H"))
        .descendant_font(refs.cid)
        .to_unicode(refs.to_unicode);
    let mut cid = pdf.cid_font(refs.cid);
    cid.subtype(CidFontType::Type2);
    cid.base_font(BASE_FONT);
    cid.system_info(IDENTITY);
    cid.font_descriptor(refs.descriptor);
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
    pdf.stream(refs.to_unicode, &cmap.finish().into_vec());
    let mut descriptor = pdf.font_descriptor(refs.descriptor);
    descriptor
        .name(BASE_FONT)
        .flags(FontFlags::NON_SYMBOLIC)
        .italic_angle(0.0)
        .stem_v(80.0)
        .font_file2(refs.file);
    if let Some(face) = font::face() {
        let unit = 1000.0 / f32::from(face.units_per_em());
        let bounds = face.global_bounding_box();
        let [left, low, right, high] = [bounds.x_min, bounds.y_min, bounds.x_max, bounds.y_max];
        let [left, low, right, high] = [left, low, right, high].map(|v| f32::from(v) * unit);
        let cap = face.capital_height().unwrap_or(714);
        descriptor
            .bbox(Rect::new(left, low, right, high))
            .ascent(f32::from(face.ascender()) * unit)
            .descent(f32::from(face.descender()) * unit)
            .cap_height(f32::from(cap) * unit);
    }
    descriptor.finish();
    let file = compress_to_vec_zlib(font::FILE, EFFORT);
    let mut stream = pdf.stream(refs.file, &file);
    stream.filter(Filter::FlateDecode);
    stream.pair(Name(b"Length1"), font::FILE.len() as i32);
}
