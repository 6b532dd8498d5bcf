//! What each word of a choice means, in a line.

use toml::Value;

use super::nearest::nearest;
use super::schema::{Kind, Parameter};
use crate::math::abel::AbelMethod;

/// What `word` means as the value of the key at `path`; `None` for words that no key takes.
pub fn meaning(path: &str, word: &str) -> Option<&'static str> {
    let key = path.rsplit_once('.').map_or(path, |(_, key)| key);
    let meaning = match (key, word) {
        ("method", name) => {
            let method = AbelMethod::ALL
                .into_iter()
                .find(|method| method.name() == name);
            return method.map(AbelMethod::description);
        }
        ("shape", "paraboloid") => "a ball near its pole: f = r² / 2R",
        ("shape", "cone") => "f = r tan(angle): infinite pressure at the tip",
        ("shape", "power") => "f = coefficient r^exponent",
        ("shape", "flat-punch") => "a flat disc: the contact radius is its radius",
        ("shape", "truncated-paraboloid") => "a ball with a flat worn or ground off",
        ("shape", "truncated-cone") => "a cone with a flat tip",
        ("shape", "rounded-punch") => "a flat disc whose edge is rounded",
        ("shape", "table") => "a measured profile from a CSV file",
        ("control", "displacement") => "the motion is prescribed, m: wear unloads the contact",
        ("control", "force") => "the load is prescribed, N: the contact sinks in as it wears",
        ("waveform", "sine") => "mean + amplitude cos(ωt + phase)",
        ("waveform", "triangle") => "constant speed between the turning points",
        ("waveform", "trapezoid") => "constant speed, and a rest at each turning point",
        ("waveform", "table") => "one period from a CSV file",
        ("law", "archard") => "depth rate = k × shear stress × slip rate: by friction work",
        ("law", "power") => "by powers of the stress and of the slip rate",
        ("grid", "graded") => "narrow cells at the stick border, where the wear is steep",
        ("grid", "uniform") => "cells of equal width, as in the paper",
        ("grid", "given") => "nodes where numerics.accuracy has placed them",
        ("scheme", "trapezoid") => "second order in time; turning points are met exactly",
        ("scheme", "euler") => "first order in time, as in the paper",
        ("stability", "sub-step") => "steps too stiff for the method are taken in parts",
        ("stability", "off") => "every step as it is: the raw method",
        ("integrator", "direct") => "every step of every cycle",
        ("integrator", "cycle-jump") => "jumps over many cycles that are alike",
        _ => return None,
    };
    Some(meaning)
}

/// A remark behind the rule that `value` breaks as one of a key's words: the word that was meant, if that
/// can be told.
pub(super) fn instead(parameter: &Parameter, value: &Value) -> String {
    let (Kind::Choice(words), Some(given)) = (parameter.kind, value.as_str()) else {
        return String::new();
    };
    let word = given.to_lowercase();
    let meant = match (parameter.key(), word.as_str()) {
        ("shape", "sphere" | "spherical" | "ball" | "hertz" | "parabola") => Some("paraboloid"),
        ("shape", "punch" | "flat" | "cylinder" | "disc") => Some("flat-punch"),
        ("control", "load" | "normal" | "stress" | "weight") => Some("force"),
        ("control", "stroke" | "depth" | "position" | "motion" | "amplitude") => {
            Some("displacement")
        }
        ("waveform", "sin" | "sinus" | "sinusoidal" | "cos" | "harmonic") => Some("sine"),
        ("law", "energy" | "linear") => Some("archard"),
        _ => nearest(&word, words.iter().copied()),
    };
    match meant.filter(|_| words.len() > 1) {
        Some(meant) => format!("; did you mean \"{meant}\"?"),
        None => String::new(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scenario::keys::PARAMETERS;

    #[test]
    fn every_word_of_every_choice_has_a_meaning() {
        for parameter in PARAMETERS {
            if let Kind::Choice(words) = parameter.kind {
                for word in words {
                    let meaning = meaning(parameter.path, word);
                    assert!(
                        meaning.is_some_and(|text| text.chars().count() <= 66),
                        "{}: {word}",
                        parameter.path
                    );
                }
            }
        }
    }
}
