//! The guide: the long documentation, shown by `mdr-tui guide` and here.
//!
//! Each topic is a Markdown file. Its shell examples are parsed by the program's own command line
//! and its scenarios are loaded, in the tests; blocks marked `sh run` are executed there as well.

/// Makes a module of each topic, and the list of all.
macro_rules! topics {
    ($($module:ident = $file:literal: $about:literal;)*) => {
        $(#[doc = include_str!($file)] pub mod $module {})*

        /// All topics, in the order in which a newcomer reads them.
        pub const TOPICS: &[Topic] = &[$(Topic {
            name: Topic::name_of_file($file),
            about: $about,
            text: include_str!($file),
        }),*];
    };
}

/// One topic.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Topic {
    /// What `mdr-tui guide NAME` calls it.
    pub name: &'static str,
    /// What it is about, in one line.
    pub about: &'static str,
    /// The text, Markdown.
    pub text: &'static str,
}

impl Topic {
    /// The name of a file without its ending.
    const fn name_of_file(file: &'static str) -> &'static str {
        let (name, ending) = file.split_at(file.len() - ".md".len());
        assert!(matches!(ending.as_bytes(), b".md"));
        name
    }

    /// Returns the rows of the glossary that name `word`: symbols and words, each with its meaning.
    pub fn explanations(word: &str) -> Vec<[&'static str; 2]> {
        let word = word.trim().to_lowercase();
        let glossary = Self::find("glossary").map_or("", |topic| topic.text);
        let rows = glossary.lines().filter_map(|line| {
            let mut cells = line.strip_prefix('|')?.split('|').map(str::trim);
            Some([cells.next()?, cells.next()?])
        });
        let is_word = word.contains(char::is_alphabetic);
        rows.filter(|[name, _]| is_word && name.to_lowercase().contains(&word))
            .collect()
    }

    /// The topic with this name.
    pub fn find(name: &str) -> Option<&'static Self> {
        TOPICS.iter().find(|topic| topic.name == name)
    }
}

topics! {
    physics = "physics.md": "the model: what is computed, and what is assumed";
    explorer = "explorer.md": "the screen and its keys";
    scenarios = "scenarios.md": "every key of a scenario file";
    files = "files.md": "what a run writes, and how to read it with pandas";
    accuracy = "accuracy.md": "asking for an accuracy, estimating errors, and what the method leaves out";
    methods = "methods.md": "the transform methods and how they compare";
    comparing = "comparing.md": "measured data, other runs and earlier states over the plots";
    paper = "paper.md": "from a test to a paper: fit, sheet, map and supplement in one sitting";
    figures = "figures.md": "figures for a paper, and the figures of the paper";
    studies = "studies.md": "many runs at once: maps, samples, clusters";
    python = "python.md": "runs and figures from Python";
    rigs = "rigs.md": "real rigs: waveforms, load blocks, compliance, measured profiles, fits";
    lines = "lines.md": "line contacts: a cylinder on a flat";
    measuring = "measuring.md": "from a rig's files to k and its error: tables, loops, scars, fits";
    published = "published.md": "published cases: what papers say, what this program gives";
    cracks = "cracks.md": "wear or crack: fatigue parameters below the surface";
    stiff_wear = "stiff-wear.md": "large wear coefficients: why steps have a limit";
    checks = "checks.md": "what a run checks of itself, and what a failing check means";
    resuming = "resuming.md": "checkpoints: how to go on after a stop";
    performance = "performance.md": "speed, and what it was compared with";
    installing = "installing.md": "one file for any host, packages";
    configuration = "configuration.md": "preferences, further keys, shell completion";
    glossary = "glossary.md": "symbols and words, with the names other papers use";
}
