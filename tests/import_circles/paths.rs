//! The paths that the items of a module use.

use std::collections::BTreeSet;

use syn::buffer::TokenBuffer;
use syn::punctuated::Punctuated;
use syn::visit::{self, Visit};
use syn::{
    Attribute, ExprMethodCall, ExprPath, Field, GenericParam, Generics, ImplItem, Item, ItemUse,
    Local, Macro, Meta, PatIdent, Path, QSelf, Token, TraitItem, TypePath, Visibility,
};

use crate::modules;
use crate::tokens;

/// What the items of a module use.
#[derive(Default)]
pub struct Used {
    /// Paths outside `use` items.
    pub paths: BTreeSet<Vec<String>>,
    /// `use` items in the bodies of functions.
    pub local_imports: Vec<ItemUse>,
    /// Names of the methods called, which traits of glob imports may provide.
    pub methods: BTreeSet<String>,
    scopes: Vec<Scope>,
}

impl Used {
    pub fn by(items: &[Item]) -> Self {
        let mut used = Self::default();
        for item in items {
            if !matches!(item, Item::Use(_)) {
                used.visit_item(item);
            }
        }
        used
    }

    /// Records a path unless it names something local: a variable, a parameter, an inner item.
    fn record(&mut self, path: Vec<String>) {
        let local = self.scopes.iter().any(|scope| scope.holds(&path));
        if !local {
            self.paths.insert(path);
        }
    }

    fn within(&mut self, scope: Scope, visit: impl FnOnce(&mut Self)) {
        self.scopes.push(scope);
        visit(self);
        self.scopes.pop();
    }

    /// Visits a path unless it belongs wholly to the type in front, as in `<T>::new`.
    fn qualified(&mut self, qself: Option<&QSelf>, path: &Path) {
        if let Some(qself) = qself {
            self.visit_type(&qself.ty);
        }
        if qself.is_some_and(|qself| qself.position == 0) {
            visit::visit_path(self, path);
        } else {
            self.visit_path(path);
        }
    }

    /// Visits what a macro is given: as expressions if it can be read so, else word by word.
    fn macro_arguments(&mut self, arguments: &Macro) {
        let expressions = Punctuated::<syn::Expr, Token![,]>::parse_terminated;
        if let Ok(expressions) = arguments.parse_body_with(expressions) {
            for expression in &expressions {
                self.visit_expr(expression);
            }
        } else {
            for path in tokens::paths(&TokenBuffer::new2(arguments.tokens.clone())) {
                self.record(path);
            }
        }
    }
}

impl<'ast> Visit<'ast> for Used {
    fn visit_item(&mut self, item: &'ast Item) {
        if modules::only_for_tests(modules::attributes(item)) {
            return;
        }
        let scope = match item {
            Item::Use(import) => {
                self.local_imports.push(import.clone());
                return;
            }
            Item::Fn(item) => Scope::of(|scope| scope.visit_item_fn(item)),
            Item::Const(item) => Scope::of(|scope| scope.visit_item_const(item)),
            Item::Static(item) => Scope::of(|scope| scope.visit_item_static(item)),
            Item::Impl(item) => Scope::of(|scope| scope.visit_generics(&item.generics)),
            Item::Trait(item) => Scope::of(|scope| scope.visit_generics(&item.generics)),
            Item::Struct(item) => Scope::of(|scope| scope.visit_generics(&item.generics)),
            Item::Enum(item) => Scope::of(|scope| scope.visit_generics(&item.generics)),
            Item::Union(item) => Scope::of(|scope| scope.visit_generics(&item.generics)),
            Item::Type(item) => Scope::of(|scope| scope.visit_generics(&item.generics)),
            _ => Scope::default(),
        };
        self.within(scope, |used| visit::visit_item(used, item));
    }

    fn visit_impl_item(&mut self, item: &'ast ImplItem) {
        let attributes: &[Attribute] = match item {
            ImplItem::Const(item) => &item.attrs,
            ImplItem::Fn(item) => &item.attrs,
            ImplItem::Type(item) => &item.attrs,
            _ => &[],
        };
        if !modules::only_for_tests(attributes) {
            let scope = Scope::of(|scope| scope.visit_impl_item(item));
            self.within(scope, |used| visit::visit_impl_item(used, item));
        }
    }

    fn visit_trait_item(&mut self, item: &'ast TraitItem) {
        let attributes: &[Attribute] = match item {
            TraitItem::Const(item) => &item.attrs,
            TraitItem::Fn(item) => &item.attrs,
            TraitItem::Type(item) => &item.attrs,
            _ => &[],
        };
        if !modules::only_for_tests(attributes) {
            let scope = Scope::of(|scope| scope.visit_trait_item(item));
            self.within(scope, |used| visit::visit_trait_item(used, item));
        }
    }

    fn visit_local(&mut self, local: &'ast Local) {
        if !modules::only_for_tests(&local.attrs) {
            visit::visit_local(self, local);
        }
    }

    fn visit_field(&mut self, field: &'ast Field) {
        if !modules::only_for_tests(&field.attrs) {
            visit::visit_field(self, field);
        }
    }

    fn visit_path(&mut self, path: &'ast Path) {
        if path.leading_colon.is_none() {
            let segments = path.segments.iter();
            self.record(segments.map(|segment| segment.ident.to_string()).collect());
        }
        visit::visit_path(self, path);
    }

    fn visit_type_path(&mut self, path: &'ast TypePath) {
        self.qualified(path.qself.as_ref(), &path.path);
    }

    fn visit_expr_path(&mut self, path: &'ast ExprPath) {
        self.qualified(path.qself.as_ref(), &path.path);
    }

    /// A pattern of one word in capitals is a constant or a variant.
    fn visit_pat_ident(&mut self, pattern: &'ast PatIdent) {
        let name = pattern.ident.to_string();
        if is_capital(&name) {
            self.record(vec![name]);
        }
        visit::visit_pat_ident(self, pattern);
    }

    fn visit_expr_method_call(&mut self, call: &'ast ExprMethodCall) {
        self.methods.insert(call.method.to_string());
        visit::visit_expr_method_call(self, call);
    }

    fn visit_macro(&mut self, invocation: &'ast Macro) {
        self.visit_path(&invocation.path);
        self.macro_arguments(invocation);
    }

    fn visit_attribute(&mut self, attribute: &'ast Attribute) {
        if let Meta::List(list) = &attribute.meta {
            for path in tokens::paths(&TokenBuffer::new2(list.tokens.clone())) {
                self.record(path);
            }
        }
    }

    fn visit_visibility(&mut self, _: &'ast Visibility) {}
}

/// Names that mean something local inside an item.
#[derive(Default)]
struct Scope {
    /// Variables.
    values: BTreeSet<String>,
    /// Generic parameters and inner items.
    items: BTreeSet<String>,
}

impl Scope {
    fn of(visit: impl FnOnce(&mut Self)) -> Self {
        let mut scope = Self::default();
        visit(&mut scope);
        scope
    }

    fn holds(&self, path: &[String]) -> bool {
        self.items.contains(&path[0]) || path.len() == 1 && self.values.contains(&path[0])
    }

    fn inner(&mut self, item: &Item) {
        let ident = match item {
            Item::Fn(item) => &item.sig.ident,
            Item::Struct(item) => &item.ident,
            Item::Enum(item) => &item.ident,
            Item::Const(item) => &item.ident,
            Item::Static(item) => &item.ident,
            Item::Trait(item) => &item.ident,
            Item::Type(item) => &item.ident,
            _ => return,
        };
        self.items.insert(ident.to_string());
    }
}

impl<'ast> Visit<'ast> for Scope {
    fn visit_item(&mut self, item: &'ast Item) {
        self.inner(item);
    }

    fn visit_generics(&mut self, generics: &'ast Generics) {
        for parameter in &generics.params {
            match parameter {
                GenericParam::Type(parameter) => self.items.insert(parameter.ident.to_string()),
                GenericParam::Const(parameter) => self.items.insert(parameter.ident.to_string()),
                _ => false,
            };
        }
    }

    fn visit_pat_ident(&mut self, pattern: &'ast PatIdent) {
        let name = pattern.ident.to_string();
        if !is_capital(&name) {
            self.values.insert(name);
        }
        visit::visit_pat_ident(self, pattern);
    }
}

/// Whether a name begins with a capital, as types, variants and constants do.
pub fn is_capital(name: &str) -> bool {
    name.starts_with(|first: char| first.is_uppercase())
}
