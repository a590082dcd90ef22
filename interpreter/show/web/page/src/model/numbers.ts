// Numbers as they are shown.

// A value with six digits of each number that has more: "0.333333" of "0.33333333333333331".
export function shortNumbers(value: string): string {
  return value.replace(/(?<![\w.])-?\d+\.\d{5,}(e[-+]?\d+)?(?![\w.])/g, (number) => {
    const value = Number(number), short = String(Math.abs(value) < 1e6 ? Number(value.toPrecision(6)) : Math.round(value));
    return short.length < number.length ? short : number;
  });
}
