//! Regions of Markdown files that are written by this crate, between texts that are not.

use crate::{Gap, Source};

/// The line before and the line after a region.
fn marks(name: &str) -> (String, String) {
    let begin = format!("<!-- {name}: written by cargo run -p dsr-spec -->");
    (begin, format!("<!-- end of {name} -->"))
}

/// The text with a region replaced; or a gap if the file has no such region.
pub(crate) fn with_region(source: &Source, name: &str, body: &str) -> Result<String, Gap> {
    let (begin, end) = marks(name);
    let found = source.text.split_once(&begin).and_then(|(before, rest)| {
        let (_, after) = rest.split_once(&end)?;
        Some((before, after))
    });
    match found {
        Some((before, after)) => Ok(format!("{before}{begin}\n\n{}\n\n{end}{after}", body.trim())),
        None => Err(Gap::NoRegion { path: source.path.clone(), begin, end }),
    }
}

#[cfg(test)]
mod tests {
    use super::{marks, with_region};
    use crate::Source;

    #[test]
    fn law_a_region_is_replaced_and_nothing_else() {
        let (begin, end) = marks("claims");
        let file = Source::new("a.md", &format!("before\n\n{begin}\nold\n{end}\n\nafter\n"));
        let written = with_region(&file, "claims", "new\n").unwrap();
        assert_eq!(written, format!("before\n\n{begin}\n\nnew\n\n{end}\n\nafter\n"));
        assert_eq!(with_region(&Source::new("a.md", &written), "claims", "new").unwrap(), written);
    }

    #[test]
    fn oracle_a_file_without_the_region_is_refused() {
        let (begin, end) = marks("claims");
        for text in [String::new(), begin.clone(), format!("{end}\n{begin}\n")] {
            let gap = with_region(&Source::new("a.md", &text), "claims", "new").unwrap_err();
            assert!(gap.to_string().starts_with("a.md: no lines `<!-- claims"), "{gap}");
        }
    }
}
