//! Reads `[security]`: by what right the master calls workers on other machines.

use std::path::PathBuf;

use super::resolved::Security;
use crate::reading::key::{Key, Takes};
use crate::reading::reader::{Field, Problems, given};

pub(super) const KEYS: [Key; 2] = [
    Key::new("certificates", Takes::Text)
        .default("none")
        .means(
            "folder with `ca.crt`, `tls.crt` and `tls.key` of the master, for workers at `https://`; \
             [linchpin certificates](command-line.md#linchpin-certificates) makes it; counts from the current folder",
        ),
    Key::new("plain_text", Takes::Flag).default("`false`").means(
        "whether workers on other machines may be reached by `http://`, where nothing is encrypted and nobody proves who they are",
    ),
];

pub(super) fn read(field: Option<Field<'_>>, problems: &mut Problems<'_>) -> Option<Security> {
    let [certificates, plain_text] = match field {
        Some(field) => field.section(problems)?.read(&KEYS, problems),
        None => [const { None }; 2],
    };
    let certificates = given(certificates, |field| match field.text(problems)? {
        "" => field.refuse("the path of a folder", problems),
        folder => Some(PathBuf::from(folder)),
    });
    let plain_text = given(plain_text, |field| field.flag(problems));
    Some(Security {
        certificates: certificates?,
        plain_text: plain_text?.unwrap_or_default(),
    })
}
