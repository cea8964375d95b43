//! Players by name, whatever the order of its parts.

use super::wildcard::{Wildcard, plain};
use crate::game::{is_known, tag};

/// Who must have played a game: each by a name of their own, with either colour.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Players(Vec<Wildcard>);

/// Why players cannot have met in one game, or are none.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
pub enum PlayersError {
    #[error("{0} names, expected at most two: so many play a game")]
    TooMany(usize),
    #[error("an empty name, expected one such as Kasparov, 'Kasparov, G*' or 'Garry Kasparov'")]
    Empty,
}

impl Players {
    /// Those of so many names, with `*` for any run of characters.
    ///
    /// # Errors
    /// More than two names, or one that is empty.
    pub fn new(names: &[String]) -> Result<Players, PlayersError> {
        if names.len() > 2 {
            return Err(PlayersError::TooMany(names.len()));
        }
        if names.iter().any(|name| name.trim().is_empty()) {
            return Err(PlayersError::Empty);
        }
        Ok(Players(names.iter().map(|name| Wildcard::new(name)).collect()))
    }

    /// Whether anyone is named.
    pub fn is_empty(&self) -> bool {
        self.0.is_empty()
    }

    /// Whether they played the game with these tags; two of them, against each other.
    pub fn played(&self, tags: &[(String, String)]) -> bool {
        let colors = || ["White", "Black"].map(|name| forms(tag(tags, name).unwrap_or_default()));
        let is = |name: &Wildcard, forms: &[String]| forms.iter().any(|form| name.matches(form));
        match &self.0[..] {
            [] => true,
            [name] => colors().iter().any(|forms| is(name, forms)),
            [one, other, ..] => {
                let [white, black] = colors();
                is(one, &white) && is(other, &black) || is(one, &black) && is(other, &white)
            }
        }
    }
}

/// The ways to write a name, plain: as it stands, the surname alone, and with the surname at the other
/// end. A surname is what stands before a comma, or the last word. Who is not known has no name.
fn forms(name: &str) -> Vec<String> {
    let name = name.trim();
    if !is_known(name) {
        return Vec::new();
    }
    let name = plain(name);
    let turned = match (name.split_once(','), name.rsplit_once(' ')) {
        (Some((surname, given)), _) => [surname.to_owned(), format!("{given} {surname}")],
        (None, Some((given, surname))) => [surname.to_owned(), format!("{surname},{given}")],
        (None, None) => return vec![name],
    };
    [name].into_iter().chain(turned).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn played(names: &[&str], white: &str, black: &str) -> bool {
        let names: Vec<String> = names.iter().map(|name| (*name).to_owned()).collect();
        let tags = [("White", white), ("Black", black)]
            .map(|(name, value)| (name.to_owned(), value.to_owned()));
        Players::new(&names).unwrap().played(&tags)
    }

    #[test]
    fn a_name_is_found_however_it_is_written() {
        for (name, yes, no) in [
            (
                "Kasparov",
                &["Kasparov, Garry", "Kasparov,G", "Garry Kasparov", "KASPAROV", "Kasparov"][..],
                &["Kasparova, Anna", "Karpov, Anatoly", "Kasparov Chess Club", "?", ""][..],
            ),
            (
                "kasparov, garry",
                &["Kasparov, Garry", "Kasparov,Garry", "Garry Kasparov"],
                &["Kasparov, G"],
            ),
            ("Garry Kasparov", &["Kasparov, Garry", "Garry Kasparov"], &["Garry", "Kasparov"]),
            ("Kasp*", &["Kasparov, Garry", "Garry Kasparov", "Kasparova, A"], &["Karpov"]),
            ("Kasparov, G*", &["Kasparov,G", "Garry Kasparov"], &["Kasparov, Sergey"]),
            ("Reti", &["Réti, Richárd", "Richard Réti"], &["Retiro"]),
            ("van Wely", &["Van Wely, Loek"], &["Wely, L"]),
            ("*", &["x"], &["?", "", " "]),
        ] {
            for player in yes {
                assert!(played(&[name], player, "Somebody"), "{name:?} {player:?}");
                assert!(played(&[name], "?", player), "{name:?} {player:?}");
            }
            for player in no {
                assert!(!played(&[name], player, "?"), "{name:?} {player:?}");
            }
        }
    }

    #[test]
    fn two_names_are_those_of_two_players() {
        for (names, white, black, expected) in [
            (["Karpov", "Kasparov"], "Kasparov, G", "Karpov, A", true),
            (["Karpov", "Kasparov"], "Karpov, A", "Kasparov, G", true),
            (["Karpov", "Kasparov"], "Karpov, A", "Short, N", false),
            (["Karpov", "Kasparov"], "Short, N", "Kasparov, G", false),
            (["Polgar", "Polgar"], "Polgar, Judit", "Polgar, Zsuzsa", true),
            (["Polgar", "Polgar"], "Polgar, Judit", "Short, N", false),
            (["Polgar", "*Judit"], "Polgar, Judit", "Short, N", false),
            (["Polgar", "*"], "Polgar, Judit", "?", false),
        ] {
            assert_eq!(played(&names, white, black), expected, "{names:?} {white} {black}");
        }
        assert!(played(&[], "?", ""));
    }

    #[test]
    fn who_cannot_be_is_told() {
        let names =
            |names: &[&str]| names.iter().map(|name| (*name).to_owned()).collect::<Vec<_>>();
        assert_eq!(Players::new(&names(&["a", "b", "c"])), Err(PlayersError::TooMany(3)));
        assert_eq!(Players::new(&names(&["a", " "])), Err(PlayersError::Empty));
    }
}
