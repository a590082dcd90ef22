declare module "d3-flextree" {
  export interface FlexNode<T> {
    data: T;
    x: number;
    y: number;
    each(visit: (node: FlexNode<T>) => void): FlexNode<T>;
  }
  interface Layout<T> {
    (tree: FlexNode<T>): FlexNode<T>;
    hierarchy(data: T): FlexNode<T>;
  }
  export function flextree<T>(options: {
    children: (data: T) => T[] | undefined;
    nodeSize: (node: FlexNode<T>) => [number, number];
    spacing?: (a: FlexNode<T>, b: FlexNode<T>) => number;
  }): Layout<T>;
}
declare module "*.css";
