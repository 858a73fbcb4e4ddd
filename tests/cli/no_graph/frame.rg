module small
const TILE = 8
