// Texts with symbols of the paper: l_4, γ_min, φ_1, and joints as $C.

import { html, svg } from "../../../pictures/page/elements.js";

const SYMBOL = /(\p{L})_(min|[A-Z]|\d)|\$([A-Z])|(?<!\p{L})([φγω])(?!\p{L})/gu;

/** Return the pieces of a text: plain, or a symbol with what stands below the line. */
export function symbolPieces(text) {
  const pieces = [];
  let at = 0;
  for (const match of text.matchAll(SYMBOL)) {
    if (match.index > at) pieces.push({ plain: text.slice(at, match.index) });
    pieces.push({ symbol: match[1] ?? match[3] ?? match[4], below: match[2] ?? "" });
    at = match.index + match[0].length;
  }
  if (at < text.length) pieces.push({ plain: text.slice(at) });
  return pieces;
}

/** Return a text without its marks, for labels that are read aloud. */
export function plainText(text) {
  return symbolPieces(text).map((piece) => piece.plain ?? piece.symbol + piece.below).join("");
}

/** Return the nodes of a text with symbols. */
export function withSymbols(text) {
  return symbolPieces(text).map(({ plain, symbol, below }) => {
    if (plain !== undefined) return document.createTextNode(plain);
    return html("span", { class: "lesson-symbol" }, html("i", {}, symbol), ...(below ? [html("sub", {}, below)] : []));
  });
}

/** Return the parts of an SVG text with symbols. */
export function svgSymbols(text) {
  return symbolPieces(text).flatMap(({ plain, symbol, below }) => {
    if (plain !== undefined) return [svg("tspan", {}, plain)];
    const parts = [svg("tspan", { class: "lesson-svg-symbol" }, symbol)];
    if (below) parts.push(svg("tspan", { class: "lesson-below", dy: 3 }, below), svg("tspan", { dy: -3 }, "\u200b"));
    return parts;
  });
}
