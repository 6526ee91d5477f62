//! The contract, from its .proto file and the comments there.

use linchpin_proto::v1::FILE_DESCRIPTOR_SET;
use prost::Message as _;
use prost_types::field_descriptor_proto::{Label, Type};
use prost_types::source_code_info::Location;
use prost_types::{
    DescriptorProto, EnumDescriptorProto, FieldDescriptorProto, FileDescriptorProto,
    FileDescriptorSet, ServiceDescriptorProto,
};

use super::{cell, code, prose};

/// Numbers of fields in descriptor.proto, of which paths to comments are made.
mod number {
    pub const FILE_SYNTAX: i32 = 12;
    pub const FILE_MESSAGE: i32 = 4;
    pub const FILE_ENUM: i32 = 5;
    pub const FILE_SERVICE: i32 = 6;
    pub const MESSAGE_FIELD: i32 = 2;
    pub const ENUM_VALUE: i32 = 2;
    pub const SERVICE_METHOD: i32 = 2;
}

pub fn page() -> String {
    let set = FileDescriptorSet::decode(FILE_DESCRIPTOR_SET).unwrap();
    let file = set
        .file
        .iter()
        .find(|file| file.name().ends_with("worker.proto"))
        .unwrap();
    let mut text = super::head("Contract");
    text += "
What a master and a worker say to each other: the gRPC service `linchpin.v1.Worker`, from
[worker.proto](../../proto/proto/linchpin/v1/worker.proto) and its comments. How to implement it stands in
[Plug in a solver](../guide/own-worker.md).

A field is *optional* if its presence is told apart from its default, and *repeated* if it is a list.

## Conventions

";
    text += &block(&comment(file, &[number::FILE_SYNTAX]));
    for (service, descriptor) in (0..).zip(&file.service) {
        text += &service_section(file, service, descriptor);
    }
    text += "\n## Messages\n";
    for (message, descriptor) in (0..).zip(&file.message_type) {
        text += &message_section(file, &[number::FILE_MESSAGE, message], descriptor);
    }
    text += "\n## Enumerations\n";
    for (index, descriptor) in (0..).zip(&file.enum_type) {
        text += &enum_section(file, &[number::FILE_ENUM, index], descriptor);
    }
    text
}

fn service_section(
    file: &FileDescriptorProto,
    service: i32,
    descriptor: &ServiceDescriptorProto,
) -> String {
    let mut text = format!(
        "\n## Service {}\n\n| call | request | answer | meaning |\n|---|---|---|---|\n",
        descriptor.name()
    );
    for (method, call) in (0..).zip(&descriptor.method) {
        let path = [
            number::FILE_SERVICE,
            service,
            number::SERVICE_METHOD,
            method,
        ];
        let stream = |is_stream: bool| if is_stream { "stream of " } else { "" };
        text += &row(&[
            code(call.name()),
            stream(call.client_streaming()).to_owned() + &link(call.input_type()),
            stream(call.server_streaming()).to_owned() + &link(call.output_type()),
            cell(&comment(file, &path)),
        ]);
    }
    text
}

fn message_section(
    file: &FileDescriptorProto,
    path: &[i32],
    descriptor: &DescriptorProto,
) -> String {
    let mut text = format!("\n### {}\n", descriptor.name());
    let about = comment(file, path);
    if !about.is_empty() {
        text += &format!("\n{}", block(&about));
    }
    if descriptor.field.is_empty() {
        return text + "\nNo fields.\n";
    }
    text += "\n| field | number | type | meaning |\n|---|---|---|---|\n";
    for (index, field) in (0..).zip(&descriptor.field) {
        let path = [path, &[number::MESSAGE_FIELD, index]].concat();
        let choice = match field.oneof_index {
            Some(oneof) if !field.proto3_optional() => {
                let oneof = &descriptor.oneof_decl[usize::try_from(oneof).unwrap()];
                format!(", one of `{}`", oneof.name())
            }
            _ => String::new(),
        };
        text += &row(&[
            code(field.name()),
            field.number().to_string(),
            type_of(field, descriptor) + &choice,
            cell(&comment(file, &path)),
        ]);
    }
    text
}

fn enum_section(
    file: &FileDescriptorProto,
    path: &[i32],
    descriptor: &EnumDescriptorProto,
) -> String {
    let mut text = format!("\n### {}\n", descriptor.name());
    let about = comment(file, path);
    if !about.is_empty() {
        text += &format!("\n{}", block(&about));
    }
    text += "\n| value | number | meaning |\n|---|---|---|\n";
    for (index, value) in (0..).zip(&descriptor.value) {
        let path = [path, &[number::ENUM_VALUE, index]].concat();
        text += &row(&[
            code(value.name()),
            value.number().to_string(),
            cell(&comment(file, &path)),
        ]);
    }
    text
}

fn type_of(field: &FieldDescriptorProto, message: &DescriptorProto) -> String {
    let is_list = field.label() == Label::Repeated;
    let entry = message.nested_type.iter().find(|nested| {
        let is_map = nested
            .options
            .as_ref()
            .is_some_and(|options| options.map_entry());
        is_map && field.type_name().ends_with(&format!(".{}", nested.name()))
    });
    if let Some(entry) = entry {
        let [key, value] = [0, 1].map(|part| type_name(&entry.field[part]));
        return format!("map from {key} to {value}");
    }
    let label = match (is_list, field.proto3_optional()) {
        (true, _) => "repeated ",
        (_, true) => "optional ",
        _ => "",
    };
    label.to_owned() + &type_name(field)
}

fn type_name(field: &FieldDescriptorProto) -> String {
    match field.r#type() {
        Type::Message | Type::Enum => link(field.type_name()),
        kind => kind
            .as_str_name()
            .trim_start_matches("TYPE_")
            .to_lowercase(),
    }
}

/// A link to the section of a message or an enumeration.
fn link(type_name: &str) -> String {
    match type_name.rsplit_once('.') {
        Some((".linchpin.v1", name)) => format!("[{name}](#{})", name.to_lowercase()),
        _ => type_name.trim_start_matches('.').to_owned(),
    }
}

/// What stands before and behind an element.
fn comment(file: &FileDescriptorProto, path: &[i32]) -> String {
    let locations = file.source_code_info.iter().flat_map(|info| &info.location);
    let found = locations.filter(|location| location.path == path);
    let texts = found.flat_map(|location: &Location| {
        let detached = location.leading_detached_comments.iter();
        let near = [&location.leading_comments, &location.trailing_comments];
        detached.chain(near.into_iter().flatten())
    });
    texts
        .map(|text| text.trim_end())
        .collect::<Vec<_>>()
        .join("\n")
}

/// A comment: a paragraph, or as it is laid out if it has lists or tables.
fn block(comment: &str) -> String {
    let lines: Vec<&str> = comment
        .lines()
        .map(|line| line.strip_prefix(' ').unwrap_or(line).trim_end())
        .collect();
    if !lines
        .iter()
        .any(|line| line.is_empty() || line.starts_with(' '))
    {
        return prose(comment);
    }
    format!("```text\n{}\n```\n", lines.join("\n"))
}

fn row(cells: &[String]) -> String {
    format!("| {} |\n", cells.join(" | "))
}
