//! The kinds of chess that games are played in, and what files call them.

use shakmaty::variant::Variant;

use crate::config::nearest;

/// By which rules a game is played, and how it begins.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Rules {
    pub variant: Variant,
    /// Whether pieces stand in another order at first, so that there has to be a FEN.
    pub is_shuffled: bool,
}

/// Names of variants in small letters and digits, first the one to call it by. Beside the tags that the
/// standard's own programs write, these are what Lichess, Chess.com, FICS, XBoard, Cute Chess, PyChess and
/// python-chess say; an empty or unknown name is standard chess.
const NAMES: [(Variant, &[&str]); 8] = [
    (
        Variant::Chess,
        &["standard", "chess", "normal", "classical", "orthodox", "regular", "fromposition", ""],
    ),
    (Variant::Crazyhouse, &["crazyhouse", "zh", "house", "crazyhousechess", "crazy"]),
    (Variant::Atomic, &["atomic", "atom", "atomicchess"]),
    (
        Variant::Antichess,
        &["antichess", "anti", "giveaway", "giveawaychess", "giveawaysuicide", "losingchess"],
    ),
    (
        Variant::ThreeCheck,
        &["threecheck", "3check", "threecheckchess", "3checkchess", "threechecks", "3checks"],
    ),
    (Variant::KingOfTheHill, &["kingofthehill", "koth", "hill", "kingofthehillchess"]),
    (Variant::Horde, &["horde", "hordechess"]),
    (Variant::RacingKings, &["racingkings", "racing", "race", "racingkingschess"]),
];

/// Names of chess with its pieces in another order.
const SHUFFLED: [&str; 12] = [
    "chess960",
    "960",
    "fischerandom",
    "fischerrandom",
    "fischerandomchess",
    "fischerrandomchess",
    "frc",
    "freestyle",
    "freestylechess",
    "chess9lx",
    "wildfr",
    "shuffled",
];

/// Variants with rules of their own, and the one that is most like each.
const OTHERS: [(&str, &str); 7] = [
    ("suicide", "antichess"),
    ("suicidechess", "antichess"),
    ("losers", "antichess"),
    ("loserschess", "antichess"),
    ("bughouse", "crazyhouse"),
    ("fivecheck", "threecheck"),
    ("5check", "threecheck"),
];

impl Rules {
    /// What a `[Variant "…"]` tag says.
    ///
    /// # Errors
    /// A variant that is not known, as a clause that names the nearest one which is.
    pub fn of_tag(value: &str) -> Result<Rules, String> {
        let plain: String = value.to_lowercase().chars().filter(|c| c.is_alphanumeric()).collect();
        let named = |name: &str| NAMES.iter().find(|(_, names)| names.contains(&name));
        if let Some((variant, _)) = named(&plain) {
            return Ok(Rules { variant: *variant, is_shuffled: false });
        }
        if SHUFFLED.contains(&plain.as_str()) {
            return Ok(Rules { variant: Variant::Chess, is_shuffled: true });
        }
        // `crazyhouse960`: another variant with its pieces in another order.
        let before = plain.strip_suffix("960").and_then(named);
        if let Some((variant, _)) = before {
            return Ok(Rules { variant: *variant, is_shuffled: true });
        }
        if let Some((_, like)) = OTHERS.iter().find(|(name, _)| *name == plain) {
            return Err(format!(
                "is a variant whose rules are not known; `{like}`, which is most like it, has others"
            ));
        }
        let known = NAMES.iter().flat_map(|(_, names)| *names).chain(&SHUFFLED).copied();
        let meant = nearest(&plain, known);
        let meant = meant.map_or(String::new(), |near| format!(" (did you mean `{near}`?)"));
        let names: Vec<&str> = NAMES.iter().map(|(_, names)| names[0]).collect();
        Err(format!(
            "is a variant that is not known, expected one of {}, {}{meant}",
            names.join(", "),
            SHUFFLED[0]
        ))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn variants_are_known_by_all_their_names() {
        let cases: [(Variant, bool, &[&str]); 11] = [
            (Variant::Chess, false, &["", "?", "Standard", "chess", "Normal", "From Position"]),
            (
                Variant::Chess,
                true,
                &[
                    "Chess960",
                    "chess 960",
                    "fischerandom",
                    "Fischer Random",
                    "fischer_random",
                    "960",
                    "Freestyle",
                    "wild/fr",
                    "Chess9LX",
                ],
            ),
            (Variant::Crazyhouse, false, &["crazyhouse", "Crazy House", "zh", "House"]),
            (Variant::Crazyhouse, true, &["Crazyhouse960", "crazyhouse 960"]),
            (Variant::Atomic, false, &["atomic", "Atom", "Atomic chess"]),
            (Variant::Atomic, true, &["atomic960"]),
            (Variant::Antichess, false, &["Antichess", "anti chess", "giveaway", "Give-away"]),
            (Variant::ThreeCheck, false, &["Three-check", "3check", "3-Check", "three_check"]),
            (Variant::KingOfTheHill, false, &["King of the Hill", "kingOfTheHill", "KOTH"]),
            (Variant::Horde, false, &["Horde", "horde chess"]),
            (Variant::RacingKings, false, &["Racing Kings", "racingKings", "race"]),
        ];
        for (variant, is_shuffled, names) in cases {
            for name in names {
                assert_eq!(Rules::of_tag(name), Ok(Rules { variant, is_shuffled }), "{name:?}");
            }
        }
    }

    #[test]
    fn no_two_variants_share_a_name() {
        let names = NAMES.iter().flat_map(|(_, names)| *names).chain(&SHUFFLED);
        let mut names: Vec<&str> =
            names.chain(OTHERS.iter().map(|(name, _)| name)).copied().collect();
        names.sort_unstable();
        for pair in names.windows(2) {
            assert_ne!(pair[0], pair[1]);
        }
    }

    #[test]
    fn other_variants_are_named_with_the_nearest_one() {
        for (name, nearest) in [
            ("suicide", "`antichess`"),
            ("Losers", "`antichess`"),
            ("Bughouse", "`crazyhouse`"),
            ("crasyhouse", "did you mean `crazyhouse`?"),
            ("kingofthehil", "did you mean `kingofthehill`?"),
            ("chess 961", "did you mean `chess960`?"),
            ("Xiangqi", "expected one of standard, crazyhouse,"),
        ] {
            let what = Rules::of_tag(name).unwrap_err();
            assert!(what.contains(nearest), "{name}: {what}");
        }
    }
}
