//! The command table as text: groups for the help, and the manual page.

use super::command::{COMMANDS, CommandRow};

/// Returns every group of commands that have keys.
pub fn groups() -> impl Iterator<Item = (&'static str, &'static [CommandRow])> {
    let groups = COMMANDS.chunk_by(|a, b| a.group == b.group);
    groups
        .filter(|rows| rows.iter().all(|row| !row.keys.is_empty()))
        .map(|rows| (rows[0].group, rows))
}

/// Returns the manual page's section on keys, in roff.
pub fn roff() -> String {
    let plain = |text: &str| text.replace('\\', "\\e").replace('-', "\\-");
    let mut text = ".SH KEYS\nThe keys of the explorer.\n".to_owned();
    for (group, rows) in groups() {
        text.push_str(&format!(".SS {group}\n"));
        for row in rows {
            let keys = row.key_names().into_iter();
            let keys: Vec<String> = keys.map(|key| format!("\\fB{}\\fR", plain(&key))).collect();
            // A line that begins with a dot would be a request.
            let help = plain(row.help);
            text.push_str(&format!(".TP\n\\&{}\n\\&{help}\n", keys.join(" ")));
        }
    }
    text
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_command_stands_in_one_group_and_is_not_cut() {
        let mut seen = 0;
        for row in groups().flat_map(|(_, rows)| rows) {
            let keys = row.key_names().join(" ");
            assert!(keys.chars().count() <= 15, "{keys}");
            assert!(row.help.chars().count() <= 58, "{}", row.help);
            seen += 1;
        }
        let with_keys = COMMANDS.iter().filter(|row| !row.keys.is_empty());
        assert_eq!(seen, with_keys.count());
    }

    #[test]
    fn every_key_stands_in_the_manual_page() {
        let roff = roff();
        for key in COMMANDS.iter().flat_map(CommandRow::key_names) {
            let key = key.replace('-', "\\-");
            assert!(roff.contains(&format!("\\fB{key}\\fR")), "{key}");
        }
    }
}
