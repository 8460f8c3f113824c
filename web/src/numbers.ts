// Numbers as a physicist writes them: as many digits as are meant, with unit and deviation.

/** What the data may leave out: optional fields are read as null. */
export type Maybe<T> = T | null | undefined;

const MINUS = '−';
export const NONE = '–';

/** With `digits` significant digits; large and small ones by powers of ten. */
export function significant(value: Maybe<number>, digits = 3): string {
  if (value === null || value === undefined || !Number.isFinite(value)) return NONE;
  if (value === 0) return '0';
  const exponent = Math.floor(Math.log10(Math.abs(value)));
  if (exponent < -4 || exponent >= Math.max(6, digits + 2)) return power(value, digits);
  return fixed(value, Math.max(0, digits - 1 - exponent));
}

/** With `decimals` digits after the point. */
export function fixed(value: number, decimals: number): string {
  const text = value.toFixed(Math.min(Math.max(decimals, 0), 12));
  const isZero = Number(text) === 0;
  return isZero ? text.replace('-', '') : text.replace('-', MINUS);
}

function power(value: number, digits: number): string {
  const [mantissa, exponent] = value.toExponential(digits - 1).split('e');
  const raised = [...String(Number(exponent))].map((c) => '⁻⁰¹²³⁴⁵⁶⁷⁸⁹'['-0123456789'.indexOf(c)]);
  return `${mantissa.replace('-', MINUS)}·10${raised.join('')}`;
}

/** How many decimals a number with this deviation deserves: those of two digits of the deviation. */
export function decimalsFor(value: number, std: Maybe<number>): number {
  const guide = std !== null && std !== undefined && std > 0 ? std : Math.abs(value) / 100;
  if (!(guide > 0) || !Number.isFinite(guide)) return 3;
  return Math.max(0, 1 - Math.floor(Math.log10(guide)));
}

/** `1.809 ± 0.016`, or the number alone. */
export function withDeviation(value: Maybe<number>, std: Maybe<number>): string {
  if (value === null || value === undefined) return NONE;
  if (Math.abs(value) >= 1e6 || (value !== 0 && Math.abs(value) < 1e-5)) {
    return std ? `${significant(value)} ± ${significant(std, 2)}` : significant(value);
  }
  const decimals = decimalsFor(value, std);
  const number = fixed(value, decimals);
  return std ? `${number} ± ${fixed(std, decimals)}` : number;
}

/** Several numbers with the same decimals: `(0.12, −0.43, 0.59)`. */
export function tuple(values: Maybe<readonly number[]>, digits = 3): string {
  if (!values) return NONE;
  if (values.length === 1) return significant(values[0], digits);
  const largest = Math.max(...values.map(Math.abs));
  if (!(largest > 0)) return `(${values.map(() => '0').join(', ')})`;
  if (largest >= 1e6 || largest < 1e-4) {
    return `(${values.map((value) => significant(value, digits)).join(', ')})`;
  }
  const decimals = Math.max(0, digits - 1 - Math.floor(Math.log10(largest)));
  return `(${values.map((value) => fixed(value, decimals)).join(', ')})`;
}

/** How probable, or how often noise alone does so. */
export function probability(value: number): string {
  if (value > 0.999) return '> 0.999';
  if (value < 0.001) return '< 0.001';
  return fixed(value, 3);
}

export function pValue(value: Maybe<number>): string {
  if (value === null || value === undefined) return NONE;
  if (value < 1e-12) return '< 10⁻¹²';
  return value < 0.001 ? significant(value, 2) : fixed(value, 3);
}

/** Metres as mm, below 10 m. */
export function length(metres: Maybe<number>, digits = 3): string {
  if (metres === null || metres === undefined) return NONE;
  return Math.abs(metres) < 1
    ? `${significant(metres * 1000, digits)} mm`
    : `${significant(metres, digits)} m`;
}

/** Radians as degrees. */
export function angle(radians: Maybe<number>, digits = 3): string {
  if (radians === null || radians === undefined) return NONE;
  return `${significant(radians * DEGREES, digits)}°`;
}

export const DEGREES = 180 / Math.PI;

/** A number with its unit, without a stray space where there is none. */
export function withUnit(text: string, unit: string): string {
  return unit === '' || text === NONE ? text : `${text} ${unit}`;
}

/** A round number, such as those along an axis, without needless zeros. */
export function short(value: number): string {
  return String(Number(value.toPrecision(6))).replace('-', MINUS);
}
