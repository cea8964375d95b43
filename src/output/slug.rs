//! Names for folders.

/// `text` in `a-z0-9` and single hyphens, at most 24 letters; empty when nothing is left.
pub fn slug(text: &str) -> String {
    const LONGEST: usize = 24;
    let mut slug = String::new();
    for character in deunicode::deunicode(text).chars() {
        if character.is_ascii_alphanumeric() {
            slug.push(character.to_ascii_lowercase());
        } else if !slug.is_empty() && !slug.ends_with('-') {
            slug.push('-');
        }
        if slug.len() == LONGEST {
            break;
        }
    }
    slug.truncate(slug.trim_end_matches('-').len());
    slug
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_become_plain_and_short() {
        let cases = [
            ("Morphy, Paul", "morphy-paul"),
            ("  Réti -- Richárd ", "reti-richard"),
            ("Алехин", "alekhin"),
            ("../../etc/passwd", "etc-passwd"),
            ("?", ""),
            ("Duke Karl of Brunswick and Count Isouard", "duke-karl-of-brunswick-a"),
        ];
        for (name, expected) in cases {
            assert_eq!(slug(name), expected);
        }
    }
}
