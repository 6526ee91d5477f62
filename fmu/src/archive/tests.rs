use std::io::Write;

use zip::ZipWriter;
use zip::write::SimpleFileOptions;

use super::*;

fn archive(entries: &[(&str, &[u8])]) -> tempfile::NamedTempFile {
    let file = tempfile::NamedTempFile::new().unwrap();
    let mut writer = ZipWriter::new(file.reopen().unwrap());
    for (name, content) in entries {
        writer
            .start_file(*name, SimpleFileOptions::default())
            .unwrap();
        writer.write_all(content).unwrap();
    }
    writer.finish().unwrap();
    file
}

#[test]
fn files_in_folders_are_written() {
    let file = archive(&[("a/b.txt", b"one"), ("c.txt", b"two")]);
    let folder = unpack(file.path()).unwrap();
    assert_eq!(fs::read(folder.path().join("a/b.txt")).unwrap(), b"one");
    assert_eq!(read(file.path(), "c.txt", 3).unwrap(), b"two");
    assert_eq!(names(file.path()).unwrap(), ["a/b.txt", "c.txt"]);
}

#[test]
fn nothing_is_written_outside_the_folder() {
    for name in ["../evil.so", "a/../../evil.so", "/tmp/evil.so"] {
        let file = archive(&[(name, b"x")]);
        let error = unpack(file.path()).unwrap_err();
        assert!(
            matches!(&error, FmuError::Outside { entry, .. } if entry == name),
            "{error}"
        );
    }
}

#[test]
fn links_are_refused() {
    let file = tempfile::NamedTempFile::new().unwrap();
    let mut writer = ZipWriter::new(file.reopen().unwrap());
    writer
        .add_symlink("resources", "/etc", SimpleFileOptions::default())
        .unwrap();
    writer.finish().unwrap();
    let error = unpack(file.path()).unwrap_err();
    assert!(matches!(error, FmuError::Outside { .. }), "{error}");
}

#[test]
fn what_is_unpacked_is_limited() {
    let zeros = vec![0; 1 << 20];
    let file = archive(&[("a", &zeros), ("b", &zeros)]);
    assert!(file.as_file().metadata().unwrap().len() < 10_000);
    assert!(unpack_within(file.path(), 2 << 20).is_ok());
    let error = unpack_within(file.path(), (2 << 20) - 1).unwrap_err();
    assert!(matches!(error, FmuError::TooLarge { .. }), "{error}");
    let error = read(file.path(), "a", 1000).unwrap_err();
    assert!(matches!(error, FmuError::TooLarge { .. }), "{error}");
}

/// An archive may lie about the size of an entry: what comes out counts.
#[test]
fn a_size_that_is_too_small_does_not_help() {
    let zeros = vec![0; 1 << 20];
    let file = archive(&[("a", &zeros)]);
    let mut bytes = fs::read(file.path()).unwrap();
    let size = (1_u32 << 20).to_le_bytes();
    let mut found = 0;
    for place in 0..bytes.len() - 4 {
        if bytes[place..place + 4] == size {
            bytes[place..place + 4].copy_from_slice(&7_u32.to_le_bytes());
            found += 1;
        }
    }
    assert_eq!(found, 2, "in the header of the entry and in the directory");
    fs::write(file.path(), bytes).unwrap();
    assert!(unpack_within(file.path(), 1000).is_err());
}
