//! Tokens to a tree, by recursive descent.
//!
//! ```text
//! expression = term { ("+" | "-") term }
//! term       = factor { ("*" | "/") factor }
//! factor     = { "-" | "+" } power
//! power      = component [ "^" factor ]
//! component  = primary { "." name }
//! primary    = number | name | name "(" list ")" | "[" list "]" | "(" expression ")"
//! list       = expression { "," expression }
//! ```

use std::ops::Range;

use super::mistake::Mistake;
use super::token::{Kind as TokenKind, Token, tokens};

/// Brackets and signs within each other; more would be generated text, and costs stack.
const DEEPEST: usize = 64;

/// A part of an expression, and where in the text it stands.
#[derive(Debug)]
pub(super) struct Expression<'a> {
    pub kind: Kind<'a>,
    pub span: Range<usize>,
}

#[derive(Debug)]
pub(super) enum Kind<'a> {
    Number(f64),
    Name(&'a str),
    Negative(Box<Expression<'a>>),
    Binary(Binary, Box<[Expression<'a>; 2]>),
    Component(Box<Expression<'a>>, &'a str),
    Call { name: &'a str, name_span: Range<usize>, arguments: Vec<Expression<'a>> },
    Vector(Vec<Expression<'a>>),
}

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Binary {
    Add,
    Subtract,
    Multiply,
    Divide,
    Power,
}

/// Parses the whole of `text`.
pub(super) fn parse(text: &str) -> Result<Expression<'_>, Mistake> {
    let mut parser = Parser { tokens: tokens(text)?, next: 0, depth: 0 };
    let whole = parser.expression()?;
    let rest = parser.peek();
    match rest.kind {
        TokenKind::End => Ok(whole),
        TokenKind::Sign(sign @ (')' | ']')) => {
            Err(Mistake::new(rest.span.clone(), format!("`{sign}` closes nothing"), "take it out"))
        }
        TokenKind::Sign(',') => {
            let mend = "write a vector as [x, y, z]; a decimal point as `.`";
            Err(Mistake::new(rest.span.clone(), "a list has no place here", mend))
        }
        _ => {
            let problem = "two values stand side by side";
            Err(Mistake::new(rest.span.clone(), problem, "write `*` between them"))
        }
    }
}

struct Parser<'a> {
    tokens: Vec<Token<'a>>,
    next: usize,
    depth: usize,
}

impl<'a> Parser<'a> {
    fn expression(&mut self) -> Result<Expression<'a>, Mistake> {
        let mut left = self.term()?;
        while let Some(sign) = self.take_one_of(&['+', '-']) {
            let binary = if sign == '+' { Binary::Add } else { Binary::Subtract };
            left = pair(binary, left, self.term()?);
        }
        Ok(left)
    }

    fn term(&mut self) -> Result<Expression<'a>, Mistake> {
        let mut left = self.factor()?;
        while let Some(sign) = self.take_one_of(&['*', '/']) {
            let binary = if sign == '*' { Binary::Multiply } else { Binary::Divide };
            left = pair(binary, left, self.factor()?);
        }
        Ok(left)
    }

    /// All that is nested passes through here.
    fn factor(&mut self) -> Result<Expression<'a>, Mistake> {
        let start = self.peek().span.clone();
        self.depth += 1;
        if self.depth > DEEPEST {
            let problem = format!("is nested deeper than {DEEPEST} levels");
            return Err(Mistake::new(start, problem, "write a simpler law"));
        }
        let factor = match self.take_one_of(&['+', '-']) {
            Some('-') => {
                let of = self.factor()?;
                let span = start.start..of.span.end;
                Expression { kind: Kind::Negative(Box::new(of)), span }
            }
            Some(_) => self.factor()?,
            None => self.power()?,
        };
        self.depth -= 1;
        Ok(factor)
    }

    fn power(&mut self) -> Result<Expression<'a>, Mistake> {
        let base = self.component()?;
        match self.take_one_of(&['^']) {
            Some(_) => Ok(pair(Binary::Power, base, self.factor()?)),
            None => Ok(base),
        }
    }

    fn component(&mut self) -> Result<Expression<'a>, Mistake> {
        let mut of = self.primary()?;
        while self.take_one_of(&['.']).is_some() {
            let token = self.take();
            let TokenKind::Name(axis) = token.kind else {
                let mend = "a component is v.x, v.y or v.z";
                return Err(Mistake::new(token.span, "a component's name is missing", mend));
            };
            let span = of.span.start..token.span.end;
            of = Expression { kind: Kind::Component(Box::new(of), axis), span };
        }
        Ok(of)
    }

    fn primary(&mut self) -> Result<Expression<'a>, Mistake> {
        let token = self.take();
        let start = token.span.start;
        let kind = match token.kind {
            TokenKind::Number(value) => Kind::Number(value),
            TokenKind::Name(name) if self.take_one_of(&['(']).is_some() => {
                let arguments = self.list(')', self.last_span())?;
                Kind::Call { name, name_span: token.span, arguments }
            }
            TokenKind::Name(name) => Kind::Name(name),
            TokenKind::Sign('[') => Kind::Vector(self.list(']', token.span)?),
            TokenKind::Sign('(') => {
                let inner = self.expression()?;
                self.close(')', token.span)?;
                // With its brackets, for the carets.
                return Ok(Expression { kind: inner.kind, span: start..self.last_span().end });
            }
            TokenKind::End if start == 0 || self.tokens.len() == 1 => {
                return Err(Mistake::new(0..0, "is empty", "write an expression, or take it out"));
            }
            TokenKind::End => {
                let mend = "write the value, or take the sign before it out";
                return Err(Mistake::new(token.span, "ends where a value is missing", mend));
            }
            TokenKind::Sign(sign) => {
                let problem = format!("a value is missing before `{sign}`");
                return Err(Mistake::new(token.span, problem, "write it, or take the sign out"));
            }
        };
        Ok(Expression { kind, span: start..self.last_span().end })
    }

    /// What stands between brackets, of which the one at `opening` is read already.
    fn list(&mut self, close: char, opening: Range<usize>) -> Result<Vec<Expression<'a>>, Mistake> {
        let mut items = Vec::new();
        if self.peek().kind != TokenKind::Sign(close) {
            items.push(self.expression()?);
            while self.take_one_of(&[',']).is_some() {
                items.push(self.expression()?);
            }
        }
        self.close(close, opening)?;
        Ok(items)
    }

    fn close(&mut self, close: char, opening: Range<usize>) -> Result<(), Mistake> {
        let found = self.peek().clone();
        match found.kind {
            TokenKind::Sign(sign) if sign == close => {
                self.take();
                Ok(())
            }
            TokenKind::End => {
                let problem = format!("this bracket is never closed by `{close}`");
                Err(Mistake::new(opening, problem, format!("write `{close}` where it ends")))
            }
            TokenKind::Sign(sign @ (')' | ']' | ',' | '.')) => {
                let problem = format!("`{sign}` where `{close}` should stand");
                Err(Mistake::new(found.span, problem, format!("write `{close}`")))
            }
            _ => {
                let problem = "two values stand side by side";
                Err(Mistake::new(found.span, problem, "write `*` or `,` between them"))
            }
        }
    }

    fn peek(&self) -> &Token<'a> {
        // The last one is the end, which is never passed.
        &self.tokens[self.next.min(self.tokens.len() - 1)]
    }

    fn take(&mut self) -> Token<'a> {
        let token = self.peek().clone();
        self.next += 1;
        token
    }

    fn take_one_of(&mut self, signs: &[char]) -> Option<char> {
        match self.peek().kind {
            TokenKind::Sign(sign) if signs.contains(&sign) => {
                self.next += 1;
                Some(sign)
            }
            _ => None,
        }
    }

    fn last_span(&self) -> Range<usize> {
        self.tokens[(self.next - 1).min(self.tokens.len() - 1)].span.clone()
    }
}

fn pair<'a>(binary: Binary, left: Expression<'a>, right: Expression<'a>) -> Expression<'a> {
    let span = left.span.start..right.span.end;
    Expression { kind: Kind::Binary(binary, Box::new([left, right])), span }
}
