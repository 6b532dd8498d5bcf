//! The terminal's abilities and background, as its environment variables describe them.

use crate::plot::Marker;
use crate::plot::theme::{Depth, Look, Theme};

/// Returns the theme of this terminal, except for what was chosen explicitly.
pub fn theme_of(marker: Option<Marker>, colored: Option<bool>, look: Option<Look>) -> Theme {
    let colored = colored.unwrap_or(variable("NO_COLOR").is_empty());
    // The Linux console has half blocks in its fonts, but no Braille.
    let is_console = variable("TERM") == "linux";
    let marker = marker.unwrap_or(match utf8_locale() {
        true if is_console => Marker::HalfBlock,
        true => Marker::Braille,
        false => Marker::Ascii,
    });
    // The Linux console does not know the query for its background and would print it.
    let follows_background = look.is_none() && colored && !is_console;
    let look = match look {
        _ if !colored => Look::Mono,
        Some(look) => look,
        None if light_background() => Look::Light,
        None => Look::Dark,
    };
    let depth = Depth::detect(&variable("COLORTERM"), &variable("TERM"));
    Theme {
        follows_background,
        ..Theme::new(look, marker).with_depth(depth)
    }
}

/// Returns the value of an environment variable; empty if unset.
fn variable(name: &str) -> String {
    let value = std::env::var_os(name).unwrap_or_default();
    value.to_string_lossy().into_owned()
}

/// Whether the terminal says that its background is light: the last number of COLORFGBG.
fn light_background() -> bool {
    let colors = variable("COLORFGBG");
    matches!(colors.rsplit(';').next(), Some("7" | "15"))
}

/// Whether the locale is UTF-8: the first of LC_ALL, LC_CTYPE and LANG that is set decides. Without any, the terminal
/// is assumed to be modern.
fn utf8_locale() -> bool {
    let locales = ["LC_ALL", "LC_CTYPE", "LANG"].map(|name| variable(name).to_ascii_lowercase());
    let decisive = locales.iter().find(|locale| !locale.is_empty());
    decisive.is_none_or(|locale| locale.contains("utf-8") || locale.contains("utf8"))
}
