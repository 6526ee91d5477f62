//! What one source file defines and which paths stand in it; test code is left out.

use std::collections::{BTreeMap, BTreeSet};

use syn::punctuated::Punctuated;
use syn::visit::{self, Visit};
use syn::{Attribute, Expr, Item, Token, UseTree};

/// The names of a path, from left to right.
pub type Names = Vec<String>;

/// A source file as far as other files have to do with it.
#[derive(Debug, Default, PartialEq)]
pub struct Source {
    /// What it defines.
    pub items: BTreeSet<String>,
    /// What it imports, by the names that it gives it; re-exports are among them.
    pub imported: BTreeMap<String, Names>,
    /// Modules whose names it imports all.
    pub globs: Vec<Names>,
    /// Every path that may lead to another file.
    pub mentions: Vec<Mention>,
}

/// A path that stands in a file.
#[derive(Debug, Clone, PartialEq)]
pub struct Mention {
    pub path: Names,
    /// Whether it stands in a `use` line.
    pub is_use: bool,
}

impl Mention {
    /// As it is written, without what it is grouped with.
    pub fn text(&self) -> String {
        let keyword = if self.is_use { "use " } else { "" };
        format!("{keyword}{}", self.path.join("::"))
    }
}

impl Source {
    /// Reads the text of a file.
    pub fn read(text: &str) -> syn::Result<Self> {
        let mut source = Self::default();
        source.visit_file(&syn::parse_file(text)?);
        Ok(source)
    }

    fn import(&mut self, tree: &UseTree, before: &mut Names) {
        match tree {
            UseTree::Path(path) => {
                before.push(path.ident.to_string());
                self.import(&path.tree, before);
                before.pop();
            }
            UseTree::Name(name) => self.import_name(before, &name.ident.to_string(), None),
            UseTree::Rename(rename) => {
                let own = rename.rename.to_string();
                self.import_name(before, &rename.ident.to_string(), Some(own));
            }
            UseTree::Glob(_) => {
                self.globs.push(before.clone());
                self.mention(before.clone(), true);
            }
            UseTree::Group(group) => {
                for tree in &group.items {
                    self.import(tree, before);
                }
            }
        }
    }

    /// The path `before::name`, or `before` itself where the name is `self` at the end of a group.
    fn import_name(&mut self, before: &Names, name: &str, own: Option<String>) {
        let mut path = before.clone();
        if name != "self" {
            path.push(name.to_owned());
        }
        if let Some(last) = path.last() {
            let own = own.unwrap_or_else(|| last.clone());
            self.imported.insert(own, path.clone());
        }
        self.mention(path, true);
    }

    fn mention(&mut self, path: Names, is_use: bool) {
        self.mentions.push(Mention { path, is_use });
    }
}

impl Visit<'_> for Source {
    fn visit_item(&mut self, item: &Item) {
        let (attributes, name) = match item {
            Item::Const(own) => (&own.attrs, Some(&own.ident)),
            Item::Enum(own) => (&own.attrs, Some(&own.ident)),
            Item::Fn(own) => (&own.attrs, Some(&own.sig.ident)),
            Item::Impl(own) => (&own.attrs, None),
            Item::Mod(own) => (&own.attrs, None),
            Item::Static(own) => (&own.attrs, Some(&own.ident)),
            Item::Struct(own) => (&own.attrs, Some(&own.ident)),
            Item::Trait(own) => (&own.attrs, Some(&own.ident)),
            Item::Type(own) => (&own.attrs, Some(&own.ident)),
            Item::Use(own) => (&own.attrs, None),
            _ => return visit::visit_item(self, item),
        };
        if !is_test(attributes) {
            self.items.extend(name.map(ToString::to_string));
            visit::visit_item(self, item);
        }
    }

    fn visit_impl_item_fn(&mut self, function: &syn::ImplItemFn) {
        if !is_test(&function.attrs) {
            visit::visit_impl_item_fn(self, function);
        }
    }

    fn visit_item_use(&mut self, item: &syn::ItemUse) {
        // Behind a leading `::` stands another crate.
        if item.leading_colon.is_none() {
            self.import(&item.tree, &mut Names::new());
        }
    }

    fn visit_path(&mut self, path: &syn::Path) {
        let names: Names = path
            .segments
            .iter()
            .map(|one| one.ident.to_string())
            .collect();
        if names.len() > 1 && path.leading_colon.is_none() {
            self.mention(names, false);
        }
        visit::visit_path(self, path);
    }

    /// The arguments of `format!`, `vec!` and their like are expressions.
    fn visit_macro(&mut self, own: &syn::Macro) {
        let arguments = Punctuated::<Expr, Token![,]>::parse_terminated;
        if let Ok(arguments) = own.parse_body_with(arguments) {
            arguments.iter().for_each(|one| self.visit_expr(one));
        }
    }

    /// `pub(super)` leads nowhere.
    fn visit_visibility(&mut self, _: &syn::Visibility) {}

    /// Nor do attributes.
    fn visit_attribute(&mut self, _: &Attribute) {}
}

fn is_test(attributes: &[Attribute]) -> bool {
    attributes.iter().any(|attribute| {
        let condition = attribute
            .path()
            .is_ident("cfg")
            .then(|| attribute.parse_args());
        condition.is_some_and(|path: syn::Result<syn::Path>| {
            path.is_ok_and(|path| path.is_ident("test"))
        })
    })
}
