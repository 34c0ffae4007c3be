/** From dark blue for 0 to yellow for 1, as `beeline reach slice` draws; the lightness rises evenly, so that it is
 * legible in grey. */
const stops = [
  [51, 31, 107],
  [43, 92, 158],
  [26, 148, 153],
  [115, 199, 102],
  [250, 230, 64],
];

/** Red, green and blue of a fraction, 0 to 255. */
export function shade(fraction: number): [number, number, number] {
  const place = Math.min(1, Math.max(0, fraction)) * (stops.length - 1);
  const k = Math.min(Math.floor(place), stops.length - 2);
  const mixed = (i: number): number => {
    const [a = 0, b = 0] = [stops[k]?.[i], stops[k + 1]?.[i]];
    return Math.round(a + (place - k) * (b - a));
  };
  return [mixed(0), mixed(1), mixed(2)];
}

/** The whole scale from left to right, a CSS image. */
export const gradient = `linear-gradient(to right, ${stops.map((stop) => `rgb(${stop.join(" ")})`).join(", ")})`;
