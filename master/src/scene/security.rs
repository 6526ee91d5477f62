//! Reads `[security]`: by what right the master calls workers on other machines.

use std::path::PathBuf;

use super::resolved::Security;
use crate::reading::key::{Key, Takes};
use crate::reading::reader::{Field, Problems, given};

pub(super) const KEYS: [Key; 3] = [
    Key::new("certificates", Takes::Text)
        .default("none")
        .means(
            "folder with `ca.crt`, `tls.crt` and `tls.key` of the master, for workers at `https://`; \
             [linchpin certificates](command-line.md#linchpin-certificates) makes it; counts from the current folder",
        ),
    Key::new("plain_text", Takes::Flag).default("`false`").means(
        "whether workers on other machines may be reached by `http://`, where nothing is encrypted and nobody proves who they are",
    ),
    Key::new("token", Takes::Text).default("none").means(
        "file with a secret that is shown to workers at `http://127.0.0.1` or `https://`, for those that were started with \
         `--token`; nobody but its user may read it",
    ),
];

pub(super) fn read(field: Option<Field<'_>>, problems: &mut Problems<'_>) -> Option<Security> {
    let [certificates, plain_text, token] = match field {
        Some(field) => field.section(problems)?.read(&KEYS, problems),
        None => [const { None }; 3],
    };
    let mut path = |field, what| {
        given(field, |field: &Field<'_>| match field.text(problems)? {
            "" => field.refuse(what, problems),
            path => Some(PathBuf::from(path)),
        })
    };
    let certificates = path(certificates, "the path of a folder");
    let token = path(token, "the path of a file");
    let plain_text = given(plain_text, |field| field.flag(problems));
    Some(Security {
        certificates: certificates?,
        plain_text: plain_text?.unwrap_or_default(),
        token: token?,
    })
}
