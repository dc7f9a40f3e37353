//! What a variant's function looks like: names and types, from which columns, GLSL and buffers follow.

use super::Language;

/// The type of one parameter or result. Every component is one f32 column.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Type {
    Float,
    Vec2,
    Vec3,
    Vec4,
    /// Column-major: component `CR` is column C, row R.
    Mat3,
}

impl Type {
    /// Number of f32 components.
    pub const fn components(self) -> usize {
        match self {
            Type::Float => 1,
            Type::Vec2 => 2,
            Type::Vec3 => 3,
            Type::Vec4 => 4,
            Type::Mat3 => 9,
        }
    }

    /// The type's name in GLSL.
    pub const fn glsl(self) -> &'static str {
        match self {
            Type::Float => "float",
            Type::Vec2 => "vec2",
            Type::Vec3 => "vec3",
            Type::Vec4 => "vec4",
            Type::Mat3 => "mat3",
        }
    }

    /// Column-name suffixes in storage order.
    pub const fn suffixes(self) -> &'static [&'static str] {
        match self {
            Type::Float => &[""],
            Type::Vec2 => &["_x", "_y"],
            Type::Vec3 => &["_x", "_y", "_z"],
            Type::Vec4 => &["_x", "_y", "_z", "_w"],
            Type::Mat3 => &["_00", "_01", "_02", "_10", "_11", "_12", "_20", "_21", "_22"],
        }
    }
}

/// A named parameter or result.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Field {
    pub name: &'static str,
    pub ty: Type,
}

impl Field {
    pub const fn new(name: &'static str, ty: Type) -> Self {
        Field { name, ty }
    }

    /// The field's column names, in storage order: `v1` of type `Vec3` gives `v1_x`, `v1_y`, `v1_z`.
    pub fn columns(&self) -> impl Iterator<Item = String> + use<> {
        let name = self.name;
        self.ty.suffixes().iter().map(move |suffix| format!("{name}{suffix}"))
    }
}

/// A family's function: its GLSL name is the family's, its result a struct when there are several.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Signature {
    /// GLSL function name, equal to the family's: `ellipse_axes`.
    pub function: &'static str,
    pub parameters: Vec<Field>,
    pub results: Vec<Field>,
}

impl Signature {
    /// Input column names in buffer order.
    pub fn input_columns(&self) -> Vec<String> {
        self.parameters.iter().flat_map(Field::columns).collect()
    }

    /// Output column names in buffer order.
    pub fn output_columns(&self) -> Vec<String> {
        self.results.iter().flat_map(Field::columns).collect()
    }

    /// The result's GLSL type: the single result's own, or the generated struct's name (`EllipseAxes`).
    pub fn result_type(&self) -> String {
        match self.results.as_slice() {
            [only] => only.ty.glsl().to_owned(),
            _ => self
                .function
                .split('_')
                .map(|word| {
                    let mut letters = word.chars();
                    letters.next().map_or_else(String::new, |first| {
                        first.to_uppercase().chain(letters).collect::<String>()
                    })
                })
                .collect(),
        }
    }

    /// The result's type in another language.
    pub fn result_type_in(&self, language: Language) -> String {
        match self.results.as_slice() {
            [only] => language.type_name(only.ty).to_owned(),
            _ => self.result_type(),
        }
    }

    /// The function's declaration as a variant's author writes it, without the body.
    pub fn declaration(&self) -> String {
        self.declaration_in(Language::Glsl)
    }

    /// The declaration in another language.
    pub fn declaration_in(&self, language: Language) -> String {
        let result = self.result_type_in(language);
        let wgsl = language == Language::Wgsl;
        let parameter = |field: &Field| {
            let ty = language.type_name(field.ty);
            if wgsl { format!("{}: {ty}", field.name) } else { format!("{ty} {}", field.name) }
        };
        let parameters = self.parameters.iter().map(parameter).collect::<Vec<_>>().join(", ");
        let function = self.function;
        if wgsl {
            format!("fn {function}({parameters}) -> {result}")
        } else {
            format!("{result} {function}({parameters})")
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn ellipse() -> Signature {
        Signature {
            function: "ellipse_axes",
            parameters: vec![Field::new("v1", Type::Vec3), Field::new("m", Type::Mat3)],
            results: vec![Field::new("major", Type::Vec3), Field::new("minor_len", Type::Float)],
        }
    }

    #[test]
    fn columns_follow_the_fields() {
        assert_eq!(
            ellipse().input_columns(),
            ["v1_x", "v1_y", "v1_z", "m_00", "m_01", "m_02", "m_10", "m_11", "m_12", "m_20", "m_21", "m_22"]
        );
        assert_eq!(ellipse().output_columns(), ["major_x", "major_y", "major_z", "minor_len"]);
    }

    #[test]
    fn one_result_needs_no_struct() {
        assert_eq!(ellipse().declaration(), "EllipseAxes ellipse_axes(vec3 v1, mat3 m)");
        let mut single = ellipse();
        single.results.truncate(1);
        assert_eq!(single.declaration(), "vec3 ellipse_axes(vec3 v1, mat3 m)");
    }
}
